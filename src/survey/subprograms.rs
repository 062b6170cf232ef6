//! The sums of subprograms, which are added wherever a subprogram is called. The sums are computed once, even if there
//! are many calls.

use std::collections::HashMap;

use super::totals::Totals;
use crate::toolpath::{Call, key};

/// The sums of a subprogram in one work offset.
#[derive(Clone, Debug)]
pub struct Part {
    /// The offset that the subprogram selects itself; `None`: the offset of the caller.
    pub work: Option<f64>,
    /// Sums of the moves in this offset.
    pub totals: Totals,
}

/// The sums of a subprogram: one entry for each work offset that it uses.
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

/// How far the sums of a subprogram are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    /// Only the subprogram's own moves are included.
    #[default]
    Own,
    /// The sums of the called subprograms are being added.
    Adding,
    /// The sums are complete.
    Known,
}

/// A subprogram, its calls, and its sums.
#[derive(Clone, Debug, Default)]
struct Sub {
    parts: Parts,
    /// The work offset that the subprogram has selected last.
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

    /// Whether a subprogram is open.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Records that the open subprogram selects a work offset.
    pub fn change_work(&mut self, work: f64) {
        if let Some((_, sub)) = &mut self.open {
            sub.work = Some(work);
        }
    }

    /// Adds moves to the open subprogram.
    pub fn add(&mut self, totals: &Totals) {
        if let Some((_, sub)) = &mut self.open
            && !totals.is_still()
        {
            sub.parts.add(sub.work, totals, 1.0);
        }
    }

    /// Adds a call in the open subprogram. `way` contains the rapid before the call. The work offset of the call is in
    /// the numbering of the form.
    pub fn call(&mut self, call: &Call, way: &Totals) {
        if let Some((_, sub)) = &mut self.open {
            let call = Call { work: call.work.or(sub.work), ..*call };
            if !way.is_still() {
                sub.parts.add(call.work, way, 1.0);
            }
            sub.calls.push(call);
        }
    }

    /// The sums of a subprogram, including all subprograms that it calls. A missing subprogram and a recursive call add
    /// nothing; printing the job refuses both.
    pub fn parts_of(&mut self, number: f64) -> &[Part] {
        let called = key(number);
        // the open subprograms, each with the index of the next call to follow
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

    /// Adds the sums of the called subprograms, which are all complete.
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
