//! Errors and warnings about parts of a program that a job can't contain, and errors that end the reading.

use crate::diag::{Code, Diag, Location};
use crate::nc::simulator::RunError;
use crate::toolpath::{ReadError, Stop};

/// Converts an error of the simulator to an error of the reader.
pub(super) fn refused(error: RunError) -> ReadError {
    match error {
        RunError::Io(error) => ReadError::Io(error),
        RunError::Refused(diag, _) => ReadError::Job(diag),
    }
}

/// The result of adding events to the job.
pub(super) type Done = Result<(), Stop>;

/// Fails with an error: a job can't contain this part of the program.
pub(super) fn unsaid<T, E: From<Box<Diag>>>(line: u64, message: impl Into<String>, help: &str) -> Result<T, E> {
    Err(Box::new(Diag::new(Code::PN036, message).help(help).place(Location::at(line, 1))).into())
}

/// A warning: the job contains this part of the program in another way, or leaves it out.
pub(super) fn warning(line: u64, message: impl Into<String>, help: &str) -> Diag {
    Diag::new(Code::PN035, message).help(help).place(Location::at(line, 1))
}
