//! Does a program make the motions that its job asked for?
//!
//! The job's events become intended cuts, each with the way that leads to it; the program is run block by block and
//! gives its cuts and ways. They are compared one by one, so that memory does not grow with either.

mod arcs;
mod begin;
mod beside;
mod calls;
mod compared;
mod comparer;
mod cut;
mod due;
mod expectation;
mod finding;
mod holes;
mod idle;
mod intended;
mod intent;
mod kept;
mod lines;
mod own;
mod passage;
mod pauses;
mod planned;
mod program;
mod programs;
mod recent;
mod report;
mod scale;
mod starts;
mod state;
mod states;
mod strokes;
mod subprograms;
mod tables;
mod threads;
mod unknown;
mod usual;
mod verdict;
mod way;
mod ways;
mod wire;
mod wire_codes;

pub use beside::{Batch, Outcome, prove_beside};
pub use comparer::Comparer;
pub use expectation::Expectation;
pub use finding::Finding;
pub use kept::Kept;
pub use programs::{Motions, NoMotion, compare_motions};
pub use report::Counts;
pub use tables::{UNPROVEN, tolerances};
pub use verdict::{Equivalences, Unproven, UnprovenKind, Verdict};
