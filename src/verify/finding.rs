//! What comparing finds.

use crate::diag::Code;
use crate::toolpath;

/// A difference or hazard: where in the job and in the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Its row in the table of codes.
    pub code: Code,
    /// What differs, with both values.
    pub message: String,
    /// What to look at.
    pub help: &'static str,
    /// The job's item, where one is concerned.
    pub place: Option<toolpath::Place>,
    /// The program's line, from 1; 0 where it has none.
    pub line: u64,
    /// That line as written.
    pub block: String,
}

/// What is another motion, and as good.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Equivalences {
    /// Holes whose pecks or retracts differ.
    pub pecks: u64,
    /// Ways that move the axes in another order, or higher.
    pub ways: u64,
    /// Arcs made of parts.
    pub arcs: u64,
    /// Straight cuts made of parts.
    pub parts: u64,
    /// Holes that are left at feed to a higher place.
    pub outs: u64,
    /// Cuts that were left and entered again where they go on.
    pub entries: u64,
    /// Feeds where the job has a rapid that turns compensation on or off.
    pub slow: u64,
}

/// The outcome.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The same motions in the same order.
    Identical,
    /// The same cuts and holes; other pecks, other ways between them.
    Equivalent(Equivalences),
    /// Something else, or something dangerous.
    Different(Vec<Finding>),
}
