//! The ways between cuts: a program may go higher than the job, never lower or elsewhere.

use std::io::{BufRead, Seek};

use super::comparer::Sides;
use super::cut::{number, shown};
use super::way::{Compared, compare, leaves_hole, leaves_low};
use crate::diag::{Code, Diag};

impl<R: BufRead + Seek> Sides<R> {
    /// The ways to a cut.
    pub(super) fn compare_ways(&mut self, line: u64) -> Result<(), Box<Diag>> {
        let tolerance = self.tolerance;
        let split = self.program.before.filter(|_| self.lost).unwrap_or(0);
        if self.lost {
            self.compare_leaving(split, line)?;
        }
        let [job, program] = &mut self.ways;
        let rest = &self.program.way[split..];
        // after a change the way begins anywhere
        let begin = if self.lost && self.program.before.is_some() { None } else { Some(self.program.start()) };
        job.set(self.start, &self.way, tolerance);
        program.set(begin, rest, tolerance);
        let known = !self.lost && self.program.start().unknown == 0;
        match compare(job, program, known, tolerance) {
            Compared::Same => Ok(()),
            Compared::AsGood { step_by_step } if step_by_step || !self.aside => {
                self.equivalences.ways += u64::from(known);
                Ok(())
            }
            Compared::AsGood { .. } => self.stays_at_wall(line),
            Compared::Turning => self.turns_otherwise(line),
            Compared::Lower(to, limit) => {
                let message = format!(
                    "a rapid goes to {}, lower than the job's ways here, Z{}",
                    shown(&to, 0b111),
                    number(limit)
                );
                self.differs(Code::PV009, line, message, "print the height before the position, or return to [rplane]")
            }
            Compared::Elsewhere(to) => {
                let message = format!("a rapid goes to {}, where the job does not go", shown(&to, 0b111));
                self.differs(Code::PV001, line, message, "look at what the form prints for this move")
            }
        }
    }

    fn stays_at_wall(&mut self, line: u64) -> Result<(), Box<Diag>> {
        let message = "the tool does not leave the wall of the hole as the job says".to_owned();
        self.differs(Code::PV001, line, message, "print the cycle's orientation and shift, as G76 Q[sleave]")
    }

    fn turns_otherwise(&mut self, line: u64) -> Result<(), Box<Diag>> {
        let message = "the spindle does not turn as the job says while the tool leaves".to_owned();
        self.differs(Code::PV011, line, message, "look at the spindle codes of the cycle")
    }

    /// The way away from the last cut of a tool or work offset, or of the program.
    pub(super) fn compare_leaving(&mut self, until: usize, line: u64) -> Result<(), Box<Diag>> {
        let tolerance = self.tolerance;
        let [job, program] = &mut self.ways;
        if self.left_start.is_none() {
            return Ok(()); // nothing was cut before
        }
        job.set(self.left_start, &self.left, tolerance);
        program.set(Some(self.program.start()), &self.program.way[..until], tolerance);
        match leaves_hole(job, program, tolerance) {
            Some(Compared::Turning) => return self.turns_otherwise(line),
            Some(_) if self.left_aside => return self.stays_at_wall(line),
            _ => {}
        }
        let [job, program] = &mut self.ways;
        let Some((to, limit)) = leaves_low(job, program, tolerance) else { return Ok(()) };
        let message = format!("after the last cut a rapid goes to {}, below Z{}", shown(&to, 0b111), number(limit));
        self.differs(Code::PV009, line, message, "go up first, as high as the job does")
    }
}
