//! The reasons why reading a job ends before the end of the job.

use super::Stop;
use crate::diag::Diag;

/// The reason why a job was not read to its end.
#[derive(Debug)]
pub enum ReadError {
    /// The input could not be read.
    Io(std::io::Error),
    /// The job has an error, or its events request something that is not possible.
    Job(Box<Diag>),
    /// The sink needs no more events. Ending early is not an error.
    Stopped,
}

impl From<Box<Diag>> for ReadError {
    fn from(diag: Box<Diag>) -> Self {
        ReadError::Job(diag)
    }
}

impl From<Stop> for ReadError {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Enough => ReadError::Stopped,
            Stop::Wrong(diag) => ReadError::Job(diag),
        }
    }
}

impl From<std::io::Error> for ReadError {
    fn from(error: std::io::Error) -> Self {
        ReadError::Io(error)
    }
}
