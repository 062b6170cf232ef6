//! Calls of the job's subprograms. Each call repeats the items of the subprogram.

use super::intended::Job;
use super::intent::{Done, Intent, unproven};
use super::tables::Unmodelled;
use crate::toolpath::{Call, Kept, Place};

/// The largest number of items that all calls together may run.
const MOST_DONE: u64 = 20_000_000;
/// The deepest nesting of calls.
const DEEPEST: u32 = 64;

impl Job {
    /// The number of subprograms that the program contains before its main program.
    pub(super) fn subprograms_first(&self) -> usize {
        if self.expectation.subs_first { self.subprograms.count() } else { 0 }
    }

    /// Runs a call: sets the work offset of the call, moves to the call's position, and runs the items of the
    /// subprogram as often as the call requests. After each run, the modal state of the calling operation is restored.
    pub(super) fn call(&mut self, call: &Call, to: &mut impl Intent) -> Done {
        let Some(index) = self.subprograms.defined.iter().position(|sub| sub.number == call.sub) else {
            return unproven(Unmodelled::MissingSubprogram);
        };
        self.subprograms.depth += 1;
        if self.subprograms.depth > DEEPEST {
            return unproven(Unmodelled::LongSubprograms);
        }
        let of_caller = self.state.work;
        if let Some(work) = call.work {
            self.work(work, to);
        }
        if call.at.given != 0 {
            self.at = self.target(&call.at);
            to.rapid(self.rapid_to(&self.at, None))?;
        }
        let items = std::mem::take(&mut self.subprograms.defined[index].items);
        let mut done = Ok(());
        let called_at = to.place();
        for _ in 0..call.times as u64 {
            done = self.run(&items, to);
            if done.is_err() {
                break;
            }
        }
        self.subprograms.defined[index].items = items;
        self.subprograms.depth -= 1;
        if done.is_ok() {
            to.comes_from(called_at); // after an error, findings still name the item with the difference
            self.work_is(of_caller, to);
        }
        done
    }

    fn run(&mut self, items: &[(Kept, Place)], to: &mut impl Intent) -> Done {
        let (state, feed, mode, css) = (self.state.clone(), self.feed, self.mode, self.css);
        self.feed = None;
        for (kept, place) in items {
            self.subprograms.done += 1;
            if self.subprograms.done > MOST_DONE {
                return unproven(Unmodelled::LongSubprograms);
            }
            to.comes_from(*place);
            self.act(kept.event(), to)?;
        }
        let of_caller = state.work;
        let work = std::mem::replace(&mut self.state, state).work;
        self.state.work = work;
        (self.feed, self.mode, self.css) = (feed, mode, css);
        self.cycle = None;
        self.work_is(of_caller, to);
        Ok(())
    }
}
