//! From a checked form to a flat program: one array of small operations, run for each event.

mod letters;
mod lower;
mod program;
mod work;

pub use letters::{Letter, LetterKind, LetterTable};
pub use lower::compile;
pub use program::{CycleStyle, Literal, Op, Program, Routine, Upon};
pub use work::WorkWord;
