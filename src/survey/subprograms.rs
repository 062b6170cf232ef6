//! Subprograms: the sums that each adds where it is called. They are computed once, for any number of calls.

use std::collections::HashMap;

use super::totals::Totals;
use crate::toolpath::{Call, key};

/// The sums of a subprogram in one work offset.
#[derive(Clone, Debug)]
pub struct Part {
    /// The offset that it sets itself; `None`: that of its caller.
    pub work: Option<f64>,
    /// Sums of its moves.
    pub totals: Totals,
}

/// The sums of a subprogram, for each of its work offsets.
#[derive(Clone, Debug, Default)]
pub struct Parts(Vec<Part>);

impl Parts {
    fn add(&mut self, work: Option<f64>, totals: &Totals, times: f64) {
        let row = self.0.iter().position(|part| part.work == work).unwrap_or_else(|| {
            self.0.push(Part { work, totals: Totals::default() });
            self.0.len() - 1
        });
        self.0[row].totals.add(totals, times);
    }
}

/// The progress in the sums of a subprogram.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    /// Only its own moves are included.
    #[default]
    Own,
    /// The subprograms that it calls are being added.
    Adding,
    /// Everything is included.
    Known,
}

/// A subprogram.
#[derive(Clone, Debug, Default)]
struct Sub {
    parts: Parts,
    /// The work offset that it has set last.
    work: Option<f64>,
    calls: Vec<Call>,
    state: State,
}

/// The subprograms of a job.
#[derive(Debug, Default)]
pub struct Subprograms {
    by_number: HashMap<u64, Sub>,
    /// The subprogram that is being defined.
    open: Option<(u64, Sub)>,
}

impl Subprograms {
    /// Begins a subprogram.
    pub fn begin(&mut self, number: f64) {
        self.open = Some((key(number), Sub::default()));
    }

    /// Ends the open subprogram.
    pub fn end(&mut self) {
        self.by_number.extend(self.open.take());
    }

    /// Is a subprogram open?
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// The open subprogram sets its work offset.
    pub fn change_work(&mut self, work: f64) {
        if let Some((_, sub)) = &mut self.open {
            sub.work = Some(work);
        }
    }

    /// Adds moves of the open subprogram.
    pub fn add(&mut self, totals: &Totals) {
        if let Some((_, sub)) = &mut self.open
            && !totals.is_still()
        {
            sub.parts.add(sub.work, totals, 1.0);
        }
    }

    /// The open subprogram calls another one, after a rapid to it. The call's offset is numbered as in the form.
    pub fn call(&mut self, call: &Call, way: &Totals) {
        if let Some((_, sub)) = &mut self.open {
            let call = Call { work: call.work.or(sub.work), ..*call };
            if !way.is_still() {
                sub.parts.add(call.work, way, 1.0);
            }
            sub.calls.push(call);
        }
    }

    /// The sums of a subprogram, with all subprograms that it calls. A missing subprogram adds nothing, and neither does a
    /// recursive call: both are refused when the job is printed.
    pub fn parts_of(&mut self, number: f64) -> &[Part] {
        let called = key(number);
        // the next call to follow, for each open subprogram
        let mut open = vec![(called, 0)];
        while let Some((number, next)) = open.pop() {
            let Some(sub) = self.by_number.get_mut(&number) else { continue };
            if next == 0 {
                if sub.state != State::Own {
                    continue;
                }
                sub.state = State::Adding;
            }
            match sub.calls.get(next) {
                Some(call) => open.extend([(number, next + 1), (key(call.sub), 0)]),
                None => self.add_called(number),
            }
        }
        self.by_number.get(&called).map_or(&[], |sub| &sub.parts.0)
    }

    /// Adds the sums of the called subprograms; all of them are complete.
    fn add_called(&mut self, number: u64) {
        let Some(sub) = self.by_number.get_mut(&number) else { return };
        let (mut parts, calls) = (std::mem::take(&mut sub.parts), std::mem::take(&mut sub.calls));
        for call in calls {
            let called = self.by_number.get(&key(call.sub)).filter(|called| called.state == State::Known);
            for part in called.map_or(&[][..], |called| &called.parts.0) {
                parts.add(part.work.or(call.work), &part.totals, call.times);
            }
        }
        self.by_number.insert(number, Sub { parts, state: State::Known, ..Sub::default() });
    }
}
