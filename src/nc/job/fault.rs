//! Errors for programs that a job can't express, and errors that end the reading.

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

/// The result of pushing events.
pub(super) type Done = Result<(), Stop>;

/// Fails with an error: no job can express this.
pub(super) fn unsaid<T, E: From<Box<Diag>>>(line: u64, message: impl Into<String>, help: &str) -> Result<T, E> {
    Err(Box::new(Diag::new(Code::PN036, message).help(help).place(Location::at(line, 1))).into())
}

/// A warning: the job expresses this differently, or leaves it out.
pub(super) fn warning(line: u64, message: impl Into<String>, help: &str) -> Diag {
    Diag::new(Code::PN035, message).help(help).place(Location::at(line, 1))
}
