//! Stops programs that are far longer than their job. The usual cause of such a long program is a wrong step or count.
//! The caller may allow programs of any length.

use std::cell::Cell;
use std::rc::Rc;

use crate::diag::{Code, Diag};
use crate::toolpath::Place;

/// Size in bytes up to which programs are always accepted.
const LARGE: u64 = 100_000_000;
/// For larger programs, the maximum size as a multiple of the job's size.
const TIMES: u64 = 1000;

/// Compares the size of a program with the size of its job.
pub struct Growth {
    /// Number of bytes of the job that were read so far. `None` if any size is accepted, or if the size of the job is
    /// unknown.
    pub read: Option<Rc<Cell<u64>>>,
    /// Number of bytes that were printed so far.
    pub printed: u64,
}

impl Growth {
    /// Adds printed bytes. `place`: the current location in the job.
    ///
    /// # Errors
    /// The program is too long for this job.
    pub fn print(&mut self, bytes: usize, place: Place) -> Result<(), Box<Diag>> {
        self.printed += bytes as u64;
        let Some(read) = self.read.as_ref().map(|read| read.get()) else { return Ok(()) };
        if self.printed <= LARGE || self.printed <= read.saturating_mul(TIMES) {
            return Ok(());
        }
        let (program, job) = (self.printed / 1_000_000, read.div_ceil(1000));
        let message = format!("more than {program} MB of program from {job} KB of job");
        let help = "check steps, pecks and counts here; `--huge` prints the program anyway";
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
        assert_eq!((diag.code, diag.message.as_str()), (Code::PR028, "more than 100 MB of program from 1 KB of job"));
        assert!(printed(None, 100_000_000).is_ok());
        assert!(printed(Some(200_000), 199_999_999).is_ok());
        assert!(printed(Some(200_000), 200_000_000).is_err());
    }
}
