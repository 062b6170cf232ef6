//! Subprograms: where they stand in the program, their numbers, and who calls whom.

use std::collections::HashMap;

use super::changes::{CONDITIONS, Served};
use super::codes::Shift;
use super::fault::{Done, fault};
use super::printer::Page;
use super::renderer::{LastMove, Renderer};
use super::rotary::Angles;
use super::vars::Vars;
use crate::compile::{Op, Routine};
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId, VarSet};
use crate::toolpath::{Axes, Call, FeedMode, Place, key};

/// What is known of the job's subprograms.
#[derive(Debug, Default)]
pub(super) struct Subprograms {
    defined: Vec<Defined>,
    /// Where each number is in `defined`.
    by_number: HashMap<u64, usize>,
    /// The calls inside subprograms.
    calls: Vec<Called>,
    /// The one that is open, as an index of `defined`.
    open: Option<usize>,
    /// Subprograms that stand after the main program wait here.
    waiting: Page,
    /// The rest of StartCode is still to be printed: subprograms come first.
    pub(super) start_waits: bool,
    /// What is so in the main program, while a subprogram is written.
    main: Option<Box<State>>,
    /// The open subprogram printed a stop, or called one that does.
    stopped: bool,
}

/// What a subprogram's own items must not change for the program around it.
#[derive(Debug)]
struct State {
    vars: Vars,
    served: Served,
    upon_used: Vec<Option<f64>>,
    angles: Angles,
    feed: Option<f64>,
}

/// What a subprogram leaves behind for its caller.
#[derive(Debug, Default)]
struct Left {
    served: Served,
    upon_used: Vec<Option<f64>>,
    /// A rotary axis turned.
    turned: bool,
    /// It stopped: spindle and coolant may stand, whoever calls it.
    stops: bool,
    /// The height at which it leaves the tool.
    height: Option<f64>,
}

impl Left {
    /// Nothing that its next run would find otherwise.
    fn is_nothing(&self) -> bool {
        self.served.known().is_empty() && !self.stops
    }
}

#[derive(Debug)]
struct Defined {
    printed: f64,
    first_block: Option<f64>,
    left: Left,
    /// It calls one that comes later: what that one leaves is not known here.
    calls_ahead: bool,
}

#[derive(Debug)]
struct Called {
    /// The calling subprogram, as an index of `defined`.
    from: usize,
    to: f64,
    place: Place,
    /// What the caller does not know of spindle, coolant and work offset, so that it can't put it back.
    unknown: VarSet,
}

impl Subprograms {
    /// Did the open subprogram stop?
    pub(super) fn has_stopped(&self) -> bool {
        self.stopped
    }

    /// A stop was printed.
    pub(super) fn stops(&mut self) {
        self.stopped |= self.open.is_some();
    }

    /// The subprogram of a number, as an index of `defined`.
    fn index(&self, number: f64) -> Option<usize> {
        self.by_number.get(&key(number)).copied()
    }

    /// Which subprograms end: those all of whose calls do. Each of the others is in a circle, or leads into one.
    fn ending(&self) -> Vec<bool> {
        let mut open = vec![0_usize; self.defined.len()];
        let mut callers = vec![Vec::new(); self.defined.len()];
        for call in &self.calls {
            if let Some(to) = self.index(call.to) {
                open[call.from] += 1;
                callers[to].push(call.from);
            }
        }
        let mut done: Vec<usize> = (0..open.len()).filter(|&sub| open[sub] == 0).collect();
        let mut ends = vec![false; open.len()];
        while let Some(sub) = done.pop() {
            ends[sub] = true;
            for &caller in &callers[sub] {
                open[caller] -= 1;
                if open[caller] == 0 {
                    done.push(caller);
                }
            }
        }
        ends
    }
}

impl Renderer<'_> {
    /// Where StartCode is divided when subprograms come first: after its leading `%` line.
    pub(super) fn start_code_rest(&self) -> usize {
        let Some(routine) = self.shape.program.routine(SequenceId::StartCode) else { return 0 };
        let ops = &self.shape.program.ops;
        let mut lines = routine.ops.clone().filter(|&i| matches!(ops[i], Op::Line { .. }));
        match lines.next() {
            Some(first) if self.is_percent(first) => lines.next().unwrap_or(routine.ops.end),
            _ => routine.ops.start,
        }
    }

    /// A subprogram begins.
    pub(super) fn sub_start(&mut self, number: f64) -> Done {
        let settings = &self.shape.program.settings;
        if settings.machine != crate::lang::Machine::Mill {
            return fault(Code::PR008, "subprograms are for mills", "put the moves into the operations");
        }
        if self.subs.index(number).is_some() {
            return fault(
                Code::PJ010,
                format!("two subprograms have the number {number}"),
                "give each a number of its own",
            );
        }
        let Some(routine) = self.shape.program.routine(SequenceId::SubStart) else {
            return fault(Code::PR008, "the form has no SubStart", "add SubStart, SubEnd and SubCall to the form");
        };
        let program = self.vars.get(VarId::Program);
        if !settings.renumber_subs && program == Some(number) {
            let message = format!("the subprogram {number} has the number of the program itself");
            return fault(Code::PJ010, message, "give one of them another number");
        }
        let last = self.subs.defined.last().map_or(0.0, |sub| sub.printed);
        let next = if program == Some(last + 1.0) { last + 2.0 } else { last + 1.0 };
        let printed = if settings.renumber_subs { next } else { number };
        let first_block = settings.numbers.letter.map(|_| self.out.number() as f64);
        let left = Left::default();
        let index = self.subs.defined.len();
        self.subs.by_number.insert(key(number), index);
        self.subs.defined.push(Defined { printed, first_block, left, calls_ahead: false });
        self.subs.open = Some(index);
        if !settings.subs_first {
            self.aside();
        }
        self.leave_main();
        self.vars.set(VarId::Sub, printed);
        self.run_with_upons(routine)
    }

    /// In a subprogram nothing is known but what it says itself.
    fn leave_main(&mut self) {
        let nothing_served = self.nothing_served();
        self.subs.main = Some(Box::new(State {
            vars: self.vars.clone(),
            served: std::mem::take(&mut self.served),
            upon_used: std::mem::replace(&mut self.upon_used, nothing_served),
            angles: self.angles.clone(),
            feed: self.feed,
        }));
        for var in CONDITIONS {
            self.vars.put(var, None);
        }
        self.forget_where();
        self.keep_feed(None);
    }

    /// For Upon sequences: whatever a subprogram says of these is a change, because its caller may have said anything.
    fn nothing_served(&self) -> Vec<Option<f64>> {
        self.shape.program.upons.iter().map(|upon| CONDITIONS.contains(&upon.var).then_some(f64::NAN)).collect()
    }

    /// The main program goes on as if the subprogram had not been written, because only calls run it.
    fn back_to_main(&mut self) {
        let turned = self.angles.is_known();
        let height = self.position.get(self.shape.depth).or(self.left_at);
        self.forget_where();
        let Some(main) = self.subs.main.take() else { return };
        let upon_used = std::mem::replace(&mut self.upon_used, main.upon_used);
        let left =
            Left { served: self.served, upon_used, turned, stops: std::mem::take(&mut self.subs.stopped), height };
        (self.vars, self.served, self.angles) = (main.vars, main.served, main.angles);
        self.keep_feed(main.feed);
        if let Some(sub) = self.subs.open.take().and_then(|open| self.subs.defined.get_mut(open)) {
            sub.left = left;
        }
    }

    /// The open subprogram ends.
    pub(super) fn sub_end(&mut self) -> Done {
        self.close_cycle()?;
        self.check_sections_closed()?;
        if self.attention {
            self.attend_here(false)?;
        }
        self.plain_cutting()?;
        if self.subs.main.as_ref().is_some_and(|main| !main.angles.wound_as(&self.angles)) {
            let help = "unwind in the main program: a call would leave the axis turned otherwise than the next expects";
            return fault(Code::PR008, "a rotary axis was unwound inside a subprogram", help);
        }
        match self.shape.program.routine(SequenceId::SubEnd) {
            Some(routine) => self.run_with_upons(routine)?,
            None => return fault(Code::PR008, "the form has no SubEnd", "add SubEnd to the form"),
        }
        if !self.shape.program.settings.subs_first {
            self.aside();
        }
        self.back_to_main();
        Ok(())
    }

    /// Subprograms begin and end in the first plane, without cutter compensation.
    fn plain_cutting(&mut self) -> Done {
        if self.compensated {
            let help = "end the compensation with an `outfeed` before";
            return fault(Code::PR006, "cutter compensation is on at the border of a subprogram", help);
        }
        self.enter_plane(17.0)
    }

    /// A call: nothing is known before and after it, because the subprogram moves the tool.
    pub(super) fn sub_call(&mut self, call: &Call) -> Done {
        self.close_cycle()?;
        let from = self.subs.open;
        let mut unknown = VarSet::default();
        for var in CONDITIONS.into_iter().filter(|&var| self.vars.get(var).is_none()) {
            unknown.insert(var);
        }
        // a call of the main program needs no look at the end: its subprogram is known here, and so is what that calls
        if let Some(from) = from {
            self.subs.calls.push(Called { from, to: call.sub, place: self.out.place, unknown });
        }
        let Some(routine) = self.shape.program.routine(SequenceId::SubCall) else {
            return fault(Code::PR008, "the form has no SubCall", "add SubCall to the form");
        };
        if self.feed_mode != FeedMode::PerMinute {
            let help = "call it from an operation whose feeds are per minute";
            return fault(Code::PR008, "a subprogram's feeds are per minute, and the caller's are not", help);
        }
        if self.angles.is_wound() {
            let help = "make the call before an axis is unwound, or turn it back first";
            return fault(Code::PR008, "a call after a rotary axis was unwound: its angles would mean others", help);
        }
        let called = self.subs.index(call.sub);
        let (printed, first_block) = match called.map(|i| &self.subs.defined[i]) {
            Some(sub) => (sub.printed, sub.first_block),
            // inside a subprogram a later one may be called; whether it comes is checked at the end
            None if from.is_some() && !self.shape.program.settings.renumber_subs => (call.sub, None),
            None if from.is_some() => {
                let help = "put the called subprogram before this one, or set `RenumSubs? N`";
                return fault(Code::PR008, format!("subprogram {} is not known yet", call.sub), help);
            }
            None => return undefined(call.sub),
        };
        let work = self.vars.get(VarId::Work);
        if call.work.is_some() && work.is_none() {
            let help = "give the subprogram its own `work` before the call";
            return fault(Code::PR008, "a call in another work offset from one that is not known here", help);
        }
        if let Some(work) = call.work {
            self.set_work(work)?;
        }
        let place = self.go_to_call(call, routine)?;
        self.vars.set(VarId::Sub, printed);
        self.vars.set(VarId::Times, call.times);
        self.vars.put(VarId::Subline, first_block);
        let leaves = called.is_none_or(|i| self.subs.defined[i].calls_ahead || !self.subs.defined[i].left.is_nothing());
        if call.times > 1.0 && called.is_some_and(|i| self.subs.defined[i].left.turned) {
            let help = "turn it back at the end of the subprogram, or call it once for each angle";
            return fault(Code::PR008, "a subprogram that leaves the part turned is called several times", help);
        }
        // a sequence that does not print how often is printed as often; so is one whose next run must begin as the first
        let together = routine.vars.has(VarId::Times) && !(leaves && call.times > 1.0);
        let calls = if together { 1 } else { call.times as u32 };
        if !together {
            self.vars.set(VarId::Times, 1.0);
        }
        for run in 0..calls {
            self.set_targets(&place)?;
            if run > 0 && leaves {
                self.knows_after_stop()?;
                self.pending_changes()?;
            }
            self.upons(routine.vars)?;
            self.way_before(routine)?;
            self.registers.forget_all();
            self.run_block(routine)?;
            self.after_call(called);
        }
        // the call's work offset is the call's alone: what follows is in the operation's again
        self.vars.put(VarId::Work, work);
        self.attention = true;
        Ok(())
    }

    /// What the call needs before it: changes that its sequence does not print, and the place it is called at.
    /// Returns the place.
    fn go_to_call(&mut self, call: &Call, routine: &Routine) -> Done<Axes> {
        self.plain_cutting()?;
        let target = self.reach(&call.at, true)?;
        self.set_targets(&target)?;
        if self.attention && !(routine.vars.has(VarId::Work) && self.only_work_waits()) {
            self.attend()?;
        }
        let at = Axes { given: call.at.given, ..target };
        // all of it: a part alone would go down before it goes across
        if (0..6).any(|axis| at.get(axis).is_some() && !self.says_axis(routine, axis)) {
            if routine.vars.has(VarId::Work) {
                self.upons(VarSet::of(&[VarId::Work]))?;
                self.work_before()?;
            }
            if self.turns(&at) { self.turn_to(&at)? } else { self.rapid_to(&at)? }
        }
        self.set_targets(&target)?;
        Ok(target)
    }

    /// In a subprogram, a move after a stop needs a spindle that it knows: its caller may have said any.
    pub(super) fn knows_after_stop(&self) -> Done {
        let unknown = |var: VarId| self.vars.get(var).is_none();
        let by_form = self.shape.program.switches_spindle; // then nothing is said again
        if !self.subs.stopped || by_form || ![VarId::Speed, VarId::Direct, VarId::Cool].into_iter().any(unknown) {
            return Ok(());
        }
        let help = "give it its own `spindle` and `coolant` before the stop";
        fault(Code::PR008, "the subprogram goes on after a stop, and nobody knows its spindle and coolant here", help)
    }

    /// The subprogram moved the tool, and changed what it says it changed.
    fn after_call(&mut self, called: Option<usize>) {
        self.fresh_tool = false;
        self.forget_where();
        let known = called.map(|i| &self.subs.defined[i]).filter(|sub| !sub.calls_ahead);
        match known {
            Some(sub) => {
                self.left_at = sub.left.height;
                if sub.left.stops {
                    (self.served.speed, self.served.direct, self.served.cool) = (None, None, None);
                }
                self.subs.stopped |= sub.left.stops && self.subs.open.is_some();
                self.served = self.served.then(&sub.left.served);
                for (used, left) in self.upon_used.iter_mut().zip(&sub.left.upon_used) {
                    *used = left.filter(|value| !value.is_nan()).or(*used);
                }
            }
            None => {
                self.served = Served::default();
                if let Some(open) = self.subs.open {
                    self.subs.defined[open].calls_ahead = true;
                }
            }
        }
    }

    /// The main program begins: what waited of StartCode, and Between.
    pub(super) fn begin_main(&mut self) -> Done {
        if !std::mem::take(&mut self.subs.start_waits) {
            return Ok(());
        }
        let program = self.shape.program;
        if !self.subs.defined.is_empty()
            && let Some(routine) = program.routine(SequenceId::Between)
        {
            self.run_with_upons(routine)?;
        }
        if let Some(routine) = program.routine(SequenceId::StartCode) {
            self.shifted = Shift::None;
            self.registers.forget_all();
            let rest = self.start_code_rest();
            self.run(rest..routine.ops.end, super::words::Mode::All)?;
        }
        self.forget_position();
        Ok(())
    }

    /// Every call has its subprogram, and none comes back to itself.
    pub(super) fn check_calls(&self) -> Done {
        let ends = self.subs.ending();
        for call in &self.subs.calls {
            let Some(to) = self.subs.index(call.to) else { return at(call.place, undefined(call.to)) };
            if self.subs.defined[to].left.served.known().meets(call.unknown) {
                let message =
                    format!("subprogram {} changes what its caller does not know and can't put back", call.to);
                let help = "say spindle, coolant and work offset in the calling subprogram before the call";
                return at(call.place, fault(Code::PR008, message, help));
            }
            // a later one that stops: its caller went on without a look at it
            let unknown = [VarId::Speed, VarId::Direct, VarId::Cool].into_iter().any(|var| call.unknown.has(var));
            if to > call.from && unknown && self.subs.defined[to].left.stops {
                let message =
                    format!("subprogram {} stops, and its caller does not know its spindle and coolant", call.to);
                let help = "say spindle and coolant in the calling subprogram before the call";
                return at(call.place, fault(Code::PR008, message, help));
            }
            if !ends[to] {
                let message = format!("subprogram {} calls itself, directly or through others", call.to);
                return at(
                    call.place,
                    fault(Code::PR008, message, "a control would run it for ever: take the call out"),
                );
            }
        }
        Ok(())
    }

    /// Subprograms that stand after the main program: appended now.
    pub(super) fn append_waiting(&mut self) {
        self.out.append(std::mem::take(&mut self.subs.waiting));
    }

    /// Is there text aside, so that the end of the program must wait for it?
    pub(super) fn has_waiting(&self) -> bool {
        !self.subs.waiting.text.is_empty()
    }

    /// What is printed outside subprograms, while one is written aside.
    pub(super) fn main_page(&mut self) -> &mut Page {
        let is_aside = self.subs.open.is_some() && !self.shape.program.settings.subs_first;
        if is_aside { &mut self.subs.waiting } else { self.out.page() }
    }

    /// Changes places with the text aside.
    fn aside(&mut self) {
        self.out.turn_to(&mut self.subs.waiting);
    }

    /// Nobody knows where the tool and the part are.
    fn forget_where(&mut self) {
        self.registers.forget_all();
        self.angles.forget();
        for var in [VarId::Rotangle, VarId::Lastrotangle, VarId::Rotaxdir] {
            self.vars.put(var, None);
        }
        self.forget_position();
    }

    /// Where the tool is, is unknown.
    fn forget_position(&mut self) {
        self.position = Axes::default();
        self.left_at = None;
        self.in_motion = None;
        self.last_move = LastMove::None;
        for var in [VarId::H, VarId::V, VarId::D, VarId::Lasth, VarId::Lastv, VarId::Lastd] {
            self.vars.put(var, None);
        }
    }
}

fn undefined<T>(number: f64) -> Done<T> {
    fault(Code::PR008, format!("the job has no subprogram {number}"), "add it to `subprograms`, before the operations")
}

/// A fault at another place than the current one.
fn at<T>(place: Place, done: Done<T>) -> Done<T> {
    done.map_err(|mut diag: Box<Diag>| {
        diag.place = Some(place.into());
        diag
    })
}
