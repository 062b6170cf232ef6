//! Differences between two NC programs: blocks are compared by their words, not by their text.

mod align;
mod gaps;
mod ignore;
mod key;
mod lines;
mod program;
mod summary;
mod targets;
mod words;

pub use align::{Comparison, Edit, Hunk, Options, compare};
pub use ignore::Ignore;
pub use program::Program;
pub use summary::Summary;
pub use words::changed_spans;
