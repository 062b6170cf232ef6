//! The reason why a cycle can't be made.

use crate::diag::{Code, Diag};
use crate::toolpath::Stop;

/// A problem of a cycle; its code has a name, such as `cycle.depth.missing`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Row in the table of codes.
    pub code: Code,
    /// The error in a sentence.
    pub message: String,
    /// A proposed correction.
    pub help: String,
}

impl Problem {
    /// A problem with this code.
    pub fn new(code: Code, message: impl Into<String>, help: impl Into<String>) -> Problem {
        Problem { code, message: message.into(), help: help.into() }
    }
}

impl From<Problem> for Box<Diag> {
    fn from(problem: Problem) -> Box<Diag> {
        Box::new(Diag::new(problem.code, problem.message).help(problem.help))
    }
}

impl From<Problem> for Stop {
    fn from(problem: Problem) -> Stop {
        Stop::Wrong(problem.into())
    }
}
