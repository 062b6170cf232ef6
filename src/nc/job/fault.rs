//! What a job can't say, and what ends its reading.

use crate::diag::{Code, Diag, Location};
use crate::nc::simulator::RunError;
use crate::toolpath::{ReadError, Stop};

/// What stopped the simulator stops the reader.
pub(super) fn refused(error: RunError) -> ReadError {
    match error {
        RunError::Io(error) => ReadError::Io(error),
        RunError::Refused(diag, _) => ReadError::Job(diag),
    }
}

/// What pushing events returns.
pub(super) type Done = Result<(), Stop>;

/// Something that no job can say.
pub(super) fn unsaid<T, E: From<Box<Diag>>>(line: u64, message: impl Into<String>, help: &str) -> Result<T, E> {
    Err(Box::new(Diag::new(Code::PN036, message).help(help).place(Location::at(line, 1))).into())
}

/// Something that is said otherwise, or left out.
pub(super) fn warning(line: u64, message: impl Into<String>, help: &str) -> Diag {
    Diag::new(Code::PN035, message).help(help).place(Location::at(line, 1))
}
