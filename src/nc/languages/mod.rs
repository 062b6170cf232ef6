//! Languages of blocks beside that of G codes with one letter: Siemens 840D, Heidenhain Klartext, Okuma OSP.
//!
//! A reader turns each block into the words and meanings that the simulator runs, so that there is one machine below all of
//! them. A block that it does not know is refused by name.

mod canned;
mod cursor;
mod formula;
pub(super) mod klartext;
pub(super) mod osp;
mod search;
pub(super) mod siemens;
mod strokes;
