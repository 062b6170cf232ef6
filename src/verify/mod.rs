//! Does a program make the motions that its job asked for?
//!
//! The job's events become intended cuts, each with the way that leads to it; the program is run block by block and
//! gives its cuts and ways. They are compared one by one, so that memory does not grow with either.

mod arcs;
mod begin;
mod comparer;
mod cut;
mod finding;
mod holes;
mod intended;
mod lines;
mod program;
mod programs;
mod state;
mod way;
mod ways;

pub use comparer::{Comparer, Counts};
pub use finding::{Equivalences, Finding, Verdict};
pub use intended::Expectation;
pub use programs::{MotionDifference, Motions, NoMotion, compare_motions};
