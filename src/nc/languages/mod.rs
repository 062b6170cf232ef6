//! Languages whose blocks are not only G codes with one-letter words: Siemens 840D, Heidenhain Klartext, Okuma OSP.
//!
//! The reader of a language converts each block to the words and meanings that the simulator runs, so one simulator
//! runs all languages. A block that a reader does not know is refused, and the message names the unknown part.

mod canned;
mod cursor;
mod formula;
pub(super) mod klartext;
pub(super) mod osp;
mod search;
pub(super) mod siemens;
mod strokes;
