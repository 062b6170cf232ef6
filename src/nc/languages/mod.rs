//! Block languages other than G codes with one letter: Siemens 840D, Heidenhain Klartext, Okuma OSP.
//!
//! A reader converts each block to the words and meanings that the simulator runs, so all languages share one machine. An
//! unknown block is refused by name.

mod canned;
mod cursor;
mod formula;
pub(super) mod klartext;
pub(super) mod osp;
mod search;
pub(super) mod siemens;
mod strokes;
