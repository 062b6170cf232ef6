//! The native language of Siemens 840D and 828D mills. Programs in the ISO mode of these controls are read as Fanuc
//! programs.
//!
//! Sources: SINUMERIK 840D/810D Programming Guide (fundamentals, job planning, cycles), and public programs.

mod arguments;
mod block;
mod checks;
mod cycles;
mod flow;
mod head;
mod search;
mod ways;

pub(in crate::nc) use ways::Siemens;
