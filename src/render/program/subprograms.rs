//! Begin and end of subprograms.

use super::sections::check_sections_closed;
use super::table::{Defined, Left, State, Subprograms};
use crate::control;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::render::cx::{Cx, Writer};
use crate::render::fault::{Done, fault};
use crate::render::prelude::enter_plane;
use crate::render::printer::{Page, Printer};
use crate::render::said::{CONDITIONS, Said, Spins};
use crate::render::settle::settle_here;
use crate::render::shape::Shape;
use crate::render::upon::run_with_upons;
use crate::render::vars::PLACE;
use crate::render::want::Want;
use crate::toolpath::{Section, key};

/// Begins a subprogram.
pub fn sub_start(number: f64, cx: &mut Cx<'_>, subs: &mut Subprograms) -> Done {
    let shape = cx.shape;
    let settings = &shape.program.settings;
    if settings.machine != crate::lang::Machine::Mill {
        return fault(Code::PR008, "subprograms are for mills", "put the moves into the operations");
    }
    if subs.index(number).is_some() {
        return fault(
            Code::PJ010,
            format!("two subprograms have the number {number}"),
            "give each subprogram its own number",
        );
    }
    let Some(routine) = shape.program.routine(SequenceId::SubStart) else {
        return fault(
            Code::PR008,
            "the form has no sequence SubStart",
            "add the sequences SubStart, SubEnd and SubCall to the form",
        );
    };
    let program = cx.want.get(VarId::Program);
    if !settings.renumber_subs && program == Some(number) {
        let message = format!("the subprogram {number} has the number of the program itself");
        return fault(Code::PJ010, message, "give the program or the subprogram another number");
    }
    let last = subs.defined.last().map_or(0.0, |sub| sub.printed);
    let next = if program == Some(last + 1.0) { last + 2.0 } else { last + 1.0 };
    let printed = if settings.renumber_subs { next } else { number };
    let first_block = settings.numbers.letter.map(|_| cx.out.number() as f64);
    let left = Left::default();
    let index = subs.defined.len();
    subs.by_number.insert(key(number), index);
    subs.defined.push(Defined { printed, first_block, left, calls_ahead: false });
    subs.open = Some(index);
    if !settings.subs_first {
        aside(cx.out, subs);
    }
    leave_main(shape, cx.want, cx.said, subs);
    cx.want.set(VarId::Sub, printed);
    run_with_upons(shape.way(routine, cx.want, cx.said), cx)
}

/// Saves the known state of the main program. The state is then discarded, because a subprogram may rely only on its
/// own words.
fn leave_main(shape: &Shape, want: &mut Want, said: &mut Said, subs: &mut Subprograms) {
    let nothing_served = nothing_served(shape);
    subs.main = Some(Box::new(State {
        vars: want.values().clone(),
        conditions: std::mem::take(&mut said.conditions),
        own: std::mem::take(&mut said.own),
        upon_used: std::mem::replace(&mut said.upon_used, nothing_served),
        angles: said.stand.angles.clone(),
        feed: want.feed(),
    }));
    want.forget(&CONDITIONS);
    forget_where(want, said);
    said.sub = Some(Spins::default());
    want.keep_feed(None, shape);
}

/// Initial values for the Upon sequences of conditions in a subprogram. Every value counts as a change, because the
/// callers of the subprogram may have set any value.
fn nothing_served(shape: &Shape) -> Vec<Option<f64>> {
    shape.program.upons.iter().map(|upon| CONDITIONS.contains(&upon.var).then_some(f64::NAN)).collect()
}

/// Restores the state of the main program after the text of a subprogram, because a subprogram runs only when it is
/// called.
fn back_to_main(shape: &Shape, want: &mut Want, said: &mut Said, subs: &mut Subprograms) {
    let turned = said.stand.angles.is_known();
    let position = said.stand.position;
    let height = said.stand.position.get(shape.depth).or(said.stand.left_at);
    forget_where(want, said);
    let Some(main) = subs.main.take() else { return };
    let upon_used = std::mem::replace(&mut said.upon_used, main.upon_used);
    let spins = said.sub.take().unwrap_or_default();
    let left = Left { conditions: said.conditions, upon_used, turned, spins, height, position };
    want.restore(main.vars);
    (said.conditions, said.own, said.stand.angles) = (main.conditions, main.own, main.angles);
    want.keep_feed(main.feed, shape);
    if let Some(sub) = subs.open.take().and_then(|open| subs.defined.get_mut(open)) {
        sub.left = left;
    }
}

/// Ends the open subprogram.
pub fn sub_end(cx: &mut Cx<'_>, subs: &mut Subprograms, sections: &[Section]) -> Done {
    let shape = cx.shape;
    check_sections_closed(sections)?;
    if cx.said.is_unsettled(cx.want) {
        settle_here(false, cx)?;
    }
    plain_cutting(&mut cx.writer())?;
    if subs.main.as_ref().is_some_and(|main| !main.angles.wound_as(&cx.said.stand.angles)) {
        let help = "unwind in the main program: after a call the angle of the axis would be unexpected";
        return fault(Code::PR033, "a rotary axis was unwound inside a subprogram", help);
    }
    match shape.routine(SequenceId::SubEnd, cx.want, cx.said) {
        Some(routine) => run_with_upons(routine, cx)?,
        None => return fault(Code::PR008, "the form has no sequence SubEnd", "add the sequence SubEnd to the form"),
    }
    if !shape.program.settings.subs_first {
        aside(cx.out, subs);
    }
    back_to_main(shape, cx.want, cx.said, subs);
    Ok(())
}

/// Checks that cutter compensation is off, and selects the XY plane. A subprogram must begin and end with compensation
/// off and in the XY plane.
pub fn plain_cutting(writer: &mut Writer<'_>) -> Done {
    if writer.want.compensated {
        let help = "end the compensation with an `outfeed` first";
        return fault(Code::PR030, "cutter compensation is on at the beginning or end of a subprogram", help);
    }
    enter_plane(control::Code::g(17), writer)
}

/// Swaps the text of the program with the stored text of subprograms.
pub fn aside(out: &mut Printer, subs: &mut Subprograms) {
    out.turn_to(&mut subs.waiting);
}

/// Appends the stored subprograms after the main program.
pub fn append_waiting(out: &mut Printer, subs: &mut Subprograms) {
    out.append(std::mem::take(&mut subs.waiting));
}

/// Whether there are stored subprograms that must be printed before the end of the program.
pub fn has_waiting(subs: &Subprograms) -> bool {
    !subs.waiting.text.is_empty()
}

/// The page of the main program, also while a subprogram is written to the stored text.
pub fn main_page<'r>(shape: &Shape, out: &'r mut Printer, subs: &'r mut Subprograms) -> &'r mut Page {
    let is_aside = subs.open.is_some() && !shape.program.settings.subs_first;
    if is_aside { &mut subs.waiting } else { out.page() }
}

/// Discards the known positions of the tool and the part.
pub fn forget_where(want: &mut Want, said: &mut Said) {
    said.forget_where();
    want.forget(&[VarId::Rotangle, VarId::Lastrotangle, VarId::Rotaxdir]);
    want.forget(&PLACE);
}
