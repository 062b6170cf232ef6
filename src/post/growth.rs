//! A program that is far longer than its job: a slip in a step or a count, unless somebody says that it is meant.

use std::cell::Cell;
use std::rc::Rc;

use crate::diag::{Code, Diag};
use crate::toolpath::Place;

/// A program up to this size is nothing to ask about.
const LARGE: u64 = 100_000_000;
/// How many times as long as its job a large program may be.
const TIMES: u64 = 1000;

/// Compares what is printed with what was read.
pub struct Growth {
    /// Bytes of the job that were read; `None`: any length is meant, or the job has no size.
    pub read: Option<Rc<Cell<u64>>>,
    /// Bytes that were printed.
    pub printed: u64,
}

impl Growth {
    /// Counts bytes that are printed, up to this place of the job.
    ///
    /// # Errors
    /// It is too much for this job.
    pub fn print(&mut self, bytes: usize, place: Place) -> Result<(), Box<Diag>> {
        self.printed += bytes as u64;
        let Some(read) = self.read.as_ref().map(|read| read.get()) else { return Ok(()) };
        if self.printed <= LARGE || self.printed <= read.saturating_mul(TIMES) {
            return Ok(());
        }
        let (program, job) = (self.printed / 1_000_000, read.div_ceil(1000));
        let message = format!("{program} MB of program from {job} KB of job, and more to come");
        let help = "look at steps, pecks and counts here; `--huge` prints it all the same";
        Err(Box::new(Diag::new(Code::PR028, message).help(help).place(place)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_longer_than_the_job_is_asked_about() {
        let printed = |job: Option<u64>, bytes: usize| {
            let mut growth = Growth { read: job.map(|read| Rc::new(Cell::new(read))), printed: 0 };
            growth.print(bytes, Place::default()).and_then(|()| growth.print(1, Place::default()))
        };
        assert!(printed(Some(10), 99_999_999).is_ok());
        let diag = printed(Some(10), 100_000_000).unwrap_err();
        assert_eq!(
            (diag.code, diag.message.as_str()),
            (Code::PR028, "100 MB of program from 1 KB of job, and more to come")
        );
        assert!(printed(None, 100_000_000).is_ok());
        assert!(printed(Some(200_000), 199_999_999).is_ok());
        assert!(printed(Some(200_000), 200_000_000).is_err());
    }
}
