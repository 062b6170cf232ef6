//! Verifies that a program makes the motions that its job requests.
//!
//! The events of the job are converted to cuts, each with the path to this cut. The program is simulated block by block
//! and is also converted to cuts and paths. The cuts and paths of job and program are compared one by one, so memory
//! does not grow with the job or the program.

mod align;
mod arcs;
mod arrival;
mod begin;
mod beside;
mod calls;
mod comparer;
mod cooled;
mod cut;
mod expectation;
mod fast_path;
mod finding;
mod folded;
mod form_values;
mod holes;
mod idle;
mod in_order;
mod intended;
mod intent;
mod lines;
mod measured;
mod modal;
mod passage;
mod pauses;
mod planned_holes;
mod program;
mod program_cuts;
mod program_passages;
mod programs;
mod rapid_path;
mod rapids;
mod recent_lines;
mod report;
mod scale;
mod sides;
mod strokes;
mod subprograms;
mod tables;
mod tails;
mod thread_starts;
mod threads;
mod unproven_codes;
mod unset;
mod verdict;
mod ways;
mod while_printing;
mod wire;
mod wire_codes;

pub use comparer::Comparer;
pub use expectation::Expectation;
pub use finding::Finding;
pub use programs::{Motions, NoMotion, compare_motions};
pub use report::Counts;
pub use tables::{UNPROVEN, tolerances};
pub use verdict::{Equivalences, Unproven, UnprovenKind, Verdict};
pub use while_printing::{Batch, Outcome, prove_beside};
