//! The language of Siemens 840D and 828D mills, native; their ISO mode is that of a Fanuc.
//!
//! Sources: SINUMERIK 840D/810D Programming Guide (fundamentals, job planning, cycles), and what public programs show.

mod block;
mod cycles;
mod flow;
mod head;
mod search;
mod ways;

pub(in crate::nc) use ways::Siemens;
