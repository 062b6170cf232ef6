//! Plans the threads in the job of a lathe, one thread start at a time.

use super::cut::{DEPTH, RADIUS, What};
use super::intended::Job;
use super::intent::{Done, Intent, Threaded};
use crate::cycle::thread_passes;
use crate::diag::Diag;
use crate::toolpath::Thread;

impl Job {
    /// Passes on a thread to the comparison, one thread start at a time.
    pub(super) fn thread(&mut self, thread: &Thread, to: &mut impl Intent) -> Done {
        let (from, end) = (self.target(&thread.from), self.target(&thread.to));
        let begin = from.values[DEPTH];
        let crest = match thread.to.given & 0b10 {
            0 => from.values[RADIUS] - thread.taper.unwrap_or(0.0),
            _ => end.values[RADIUS],
        };
        let slope = (from.values[RADIUS] - crest) / (begin - end.values[DEPTH]).abs();
        let count = thread.passes.map(|count| count as usize);
        let passes = thread_passes(thread.depth.abs(), thread.first_depth, count, thread.min_depth.unwrap_or(0.0))
            .map_err(Box::<Diag>::from)?;
        let starts = thread.starts.unwrap_or(1.0);
        for start in 0..starts as u32 {
            // each further start of the thread begins one pitch farther away from it
            let back = f64::from(start) * thread.pitch * if begin >= end.values[DEPTH] { 1.0 } else { -1.0 };
            let mut beside = self.at;
            beside.set(DEPTH, begin + back);
            self.at = beside;
            to.rapid(self.rapid_to(&beside, None))?;
            let expected = Threaded {
                begin: self.whole(&beside),
                end: end.values[DEPTH],
                crest,
                taper: slope * (begin + back - end.values[DEPTH]).abs(),
                inward: if thread.depth < 0.0 { 1.0 } else { -1.0 },
                passes: passes.clone(),
                lead: thread.pitch * starts,
            };
            let cut = self.cut(What::Line { to: self.whole(&beside) });
            to.thread(&cut, &expected)?;
        }
        Ok(())
    }
}
