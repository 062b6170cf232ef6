//! Subprograms: where they stand in the program, their numbers, and who calls whom.

use super::fault::{Done, fault};
use super::output::TraceLine;
use super::renderer::{LastMove, Renderer};
use crate::compile::Op;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::toolpath::{Axes, Call, Place};

/// What is known of the job's subprograms.
#[derive(Debug, Default)]
pub(super) struct Subprograms {
    defined: Vec<Defined>,
    calls: Vec<Called>,
    /// The one that is open, as an index of `defined`.
    open: Option<usize>,
    /// Subprograms that stand after the main program wait here.
    waiting: Waiting,
    /// The rest of StartCode is still to be printed: subprograms come first.
    pub(super) start_waits: bool,
}

/// Text that stands aside, with its source map.
#[derive(Debug, Default)]
struct Waiting {
    text: Vec<u8>,
    trace: Vec<TraceLine>,
    lines: u64,
}

#[derive(Debug)]
struct Defined {
    number: f64,
    printed: f64,
    first_block: Option<f64>,
}

#[derive(Debug)]
struct Called {
    from: Option<f64>,
    to: f64,
    place: Place,
}

impl Renderer<'_> {
    /// Where StartCode is divided when subprograms come first: after its leading `%` line.
    pub(super) fn start_code_rest(&self) -> usize {
        let Some(block) = self.program.block(SequenceId::StartCode) else { return 0 };
        let ops = &self.program.ops;
        let mut lines = block.ops.clone().filter(|&i| matches!(ops[i], Op::Line { .. }));
        match lines.next() {
            Some(first) if self.is_percent(first) => lines.next().unwrap_or(block.ops.end),
            _ => block.ops.start,
        }
    }

    /// A subprogram begins.
    pub(super) fn sub_start(&mut self, number: f64) -> Done {
        let settings = &self.program.settings;
        if settings.machine != crate::lang::Machine::Mill {
            return fault(Code::PR008, "subprograms are for mills", "put the moves into the operations");
        }
        if self.subs.defined.iter().any(|sub| sub.number == number) {
            return fault(
                Code::PJ010,
                format!("two subprograms have the number {number}"),
                "give each a number of its own",
            );
        }
        let Some(block) = self.program.block(SequenceId::SubStart) else {
            return fault(Code::PR008, "the form has no SubStart", "add SubStart, SubEnd and SubCall to the form");
        };
        let printed = if settings.renumber_subs { self.subs.defined.len() as f64 + 1.0 } else { number };
        let first_block = settings.numbers.letter.map(|_| self.out.number() as f64);
        self.subs.defined.push(Defined { number, printed, first_block });
        self.subs.open = Some(self.subs.defined.len() - 1);
        if !settings.subs_first {
            self.aside();
        }
        self.vars.set(VarId::Sub, printed);
        self.forget_where();
        self.keep_feed(None);
        self.run_with_upons(block)
    }

    /// The open subprogram ends.
    pub(super) fn sub_end(&mut self) -> Done {
        self.close_cycle()?;
        self.check_sections_closed()?;
        match self.program.block(SequenceId::SubEnd) {
            Some(block) => self.run_with_upons(block)?,
            None => return fault(Code::PR008, "the form has no SubEnd", "add SubEnd to the form"),
        }
        if !self.program.settings.subs_first {
            self.aside();
        }
        self.subs.open = None;
        self.forget_where();
        Ok(())
    }

    /// A call: nothing is known before and after it, because the subprogram moves the tool.
    pub(super) fn sub_call(&mut self, call: &Call) -> Done {
        self.close_cycle()?;
        let from = self.subs.open.map(|open| self.subs.defined[open].number);
        self.subs.calls.push(Called { from, to: call.sub, place: self.place });
        let Some(block) = self.program.block(SequenceId::SubCall) else {
            return fault(Code::PR008, "the form has no SubCall", "add SubCall to the form");
        };
        let defined = self.subs.defined.iter().find(|sub| sub.number == call.sub);
        let (printed, first_block) = match defined {
            Some(sub) => (sub.printed, sub.first_block),
            // inside a subprogram a later one may be called; whether it comes is checked at the end
            None if from.is_some() && !self.program.settings.renumber_subs => (call.sub, None),
            None if from.is_some() => {
                let help = "put the called subprogram before this one, or set `RenumSubs? N`";
                return fault(Code::PR008, format!("subprogram {} is not known yet", call.sub), help);
            }
            None => return undefined(call.sub),
        };
        let work = self.vars.get(VarId::Work);
        if let Some(work) = call.work {
            self.set_work(work);
        }
        let target = self.target(&call.at);
        self.set_targets(&target)?;
        if self.attention && !block.vars.has(VarId::Work) {
            self.attend()?;
        }
        self.vars.set(VarId::Sub, printed);
        self.vars.set(VarId::Times, call.times);
        self.vars.put(VarId::Subline, first_block);
        self.registers.forget_all();
        self.run_with_upons(block)?;
        self.forget_where();
        // the call's work offset is the call's alone: what follows is in the operation's again
        self.vars.put(VarId::Work, work);
        self.attention = true;
        Ok(())
    }

    /// The main program begins: what waited of StartCode, and Between.
    pub(super) fn begin_main(&mut self) -> Done {
        if !std::mem::take(&mut self.subs.start_waits) {
            return Ok(());
        }
        let program = self.program;
        if !self.subs.defined.is_empty()
            && let Some(block) = program.block(SequenceId::Between)
        {
            self.run_with_upons(block)?;
        }
        if let Some(block) = program.block(SequenceId::StartCode) {
            self.shifted = false;
            self.registers.forget_all();
            let rest = self.start_code_rest();
            self.run(rest..block.ops.end, super::words::Mode::All)?;
        }
        self.forget_position();
        Ok(())
    }

    /// Every call has its subprogram, and none comes back to itself.
    pub(super) fn check_calls(&self) -> Done {
        for call in &self.subs.calls {
            if !self.subs.defined.iter().any(|sub| sub.number == call.to) {
                return at(call.place, undefined(call.to));
            }
            // depth first from each call: a chain longer than there are subprograms is a circle
            let mut open: Vec<f64> = call.from.into_iter().collect();
            if self.comes_back(call.to, &mut open) {
                let message = format!("subprogram {} calls itself, directly or through others", call.to);
                return at(
                    call.place,
                    fault(Code::PR008, message, "a control would run it for ever: take the call out"),
                );
            }
        }
        Ok(())
    }

    fn comes_back(&self, number: f64, open: &mut Vec<f64>) -> bool {
        if open.contains(&number) {
            return true;
        }
        open.push(number);
        let found = self.subs.calls.iter().any(|call| call.from == Some(number) && self.comes_back(call.to, open));
        open.pop();
        found
    }

    /// Subprograms that stand after the main program: appended now. Whether there were any.
    pub(super) fn append_waiting(&mut self) {
        let waiting = std::mem::take(&mut self.subs.waiting);
        let before = self.out.lines;
        self.out.text.extend_from_slice(&waiting.text);
        self.out.lines += waiting.lines;
        if let Some(trace) = &mut self.out.trace {
            trace.extend(waiting.trace.iter().map(|line| TraceLine { line: line.line + before, ..*line }));
        }
    }

    /// Is there text aside, so that the end of the program must wait for it?
    pub(super) fn has_waiting(&self) -> bool {
        !self.subs.waiting.text.is_empty()
    }

    /// The text outside subprograms, while one is written aside.
    pub(super) fn main_text(&mut self) -> &mut Vec<u8> {
        if self.is_aside() { &mut self.subs.waiting.text } else { &mut self.out.text }
    }

    /// Its source map.
    pub(super) fn main_trace(&mut self) -> Option<&mut Vec<TraceLine>> {
        let aside = self.is_aside();
        let trace = self.out.trace.as_mut()?;
        Some(if aside { &mut self.subs.waiting.trace } else { trace })
    }

    fn is_aside(&self) -> bool {
        self.subs.open.is_some() && !self.program.settings.subs_first
    }

    /// Changes places with the text aside.
    fn aside(&mut self) {
        let waiting = &mut self.subs.waiting;
        std::mem::swap(&mut self.out.text, &mut waiting.text);
        std::mem::swap(&mut self.out.lines, &mut waiting.lines);
        if let Some(trace) = &mut self.out.trace {
            std::mem::swap(trace, &mut waiting.trace);
        }
    }

    /// Nothing is known of the machine any more.
    fn forget_where(&mut self) {
        self.registers.forget_all();
        self.forget_position();
    }

    /// Where the tool is, is unknown.
    fn forget_position(&mut self) {
        self.position = Axes::default();
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
        diag.place = Some(place.to_string());
        diag
    })
}
