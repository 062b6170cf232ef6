//! Compiles a checked form to a list of small operations. For each event, the renderer runs a part of this list.

mod ahead;
mod find_work;
mod letters;
mod lower;
mod program;
mod routine;
mod sources;
mod work;

pub use ahead::Asks;
pub use letters::{Letter, LetterKind, LetterTable};
pub use lower::compile;
pub use program::{CycleStyle, List, Literal, Op, Program, Upon};
pub use routine::{Node, Routine};
pub use sources::Sources;
pub use work::{WorkWord, WorkWords};
