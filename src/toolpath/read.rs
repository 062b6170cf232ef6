//! Why reading a job ends early.

use crate::diag::Diag;

/// Why a job was not read to its end.
#[derive(Debug)]
pub enum ReadError {
    /// The input could not be read.
    Io(std::io::Error),
    /// The job is wrong, or what its events asked for is.
    Job(Box<Diag>),
}

impl From<Box<Diag>> for ReadError {
    fn from(diag: Box<Diag>) -> Self {
        ReadError::Job(diag)
    }
}
