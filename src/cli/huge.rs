//! A program that is far longer than its job: a slip in a step or a count, unless somebody says that it is meant.

use std::cell::Cell;
use std::io::{self, Read};
use std::rc::Rc;

use postform::diag::{Code, Diag};
use postform::toolpath::Place;

/// A program up to this size is nothing to ask about.
const LARGE: u64 = 100_000_000;
/// So many times as long as its job.
const TIMES: u64 = 1000;

/// Compares what is printed with what was read.
pub struct Growth {
    read: Rc<Cell<u64>>,
    printed: u64,
    allowed: bool,
}

impl Growth {
    /// `allowed`: `--huge`.
    pub fn new(allowed: bool) -> Growth {
        Growth { read: Rc::default(), printed: 0, allowed }
    }

    /// The job, whose bytes are counted as they are read: a pipe has no size.
    pub fn of(&self, input: Box<dyn Read>) -> Box<dyn Read> {
        Box::new(Counted { input, read: Rc::clone(&self.read) })
    }

    /// So much more is printed, up to this place of the job.
    ///
    /// # Errors
    /// It is too much for this job.
    pub fn print(&mut self, bytes: usize, place: Place) -> Result<(), Box<Diag>> {
        self.printed += bytes as u64;
        let read = self.read.get();
        if self.allowed || self.printed <= LARGE || self.printed <= read.saturating_mul(TIMES) {
            return Ok(());
        }
        let (program, job) = (self.printed / 1_000_000, read.div_ceil(1000));
        let message = format!("{program} MB of program from {job} KB of job, and more to come");
        let help = "look at steps, pecks and counts here; `--huge` prints it all the same";
        Err(Box::new(Diag::new(Code::PR028, message).help(help).place(place)))
    }
}

struct Counted {
    input: Box<dyn Read>,
    read: Rc<Cell<u64>>,
}

impl Read for Counted {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let count = self.input.read(out)?;
        self.read.set(self.read.get() + count as u64);
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_longer_than_the_job_is_asked_about() {
        let printed = |job: u64, allowed: bool, bytes: usize| {
            let mut growth = Growth::new(allowed);
            io::copy(&mut growth.of(Box::new(io::repeat(b' ').take(job))), &mut io::sink()).unwrap();
            growth.print(bytes, Place::default()).and_then(|()| growth.print(1, Place::default()))
        };
        assert!(printed(10, false, 99_999_999).is_ok());
        let diag = printed(10, false, 100_000_000).unwrap_err();
        assert_eq!(
            (diag.code, diag.message.as_str()),
            (Code::PR028, "100 MB of program from 1 KB of job, and more to come")
        );
        assert!(printed(10, true, 100_000_000).is_ok());
        assert!(printed(200_000, false, 199_999_999).is_ok());
        assert!(printed(200_000, false, 200_000_000).is_err());
    }
}
