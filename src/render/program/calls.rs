//! Calls of subprograms.

use super::subprograms::{forget_where, plain_cutting};
use super::table::{Called, Subprograms};
use crate::compile::Routine;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId, VarSet};
use crate::render::body::run_all;
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::moves::prepare::reach;
use crate::render::moves::rapid_blocks::rapid_to;
use crate::render::moves::rotary::turn_to;
use crate::render::prelude::way_before;
use crate::render::prints::{prints_axis, says_work};
use crate::render::said::{CONDITIONS, Conditions, Said};
use crate::render::settle::{knows_after_stop, only_work_waits, print_conditions, settle};
use crate::render::shape::Shape;
use crate::render::targets::set_targets;
use crate::render::upon::upons;
use crate::render::want::Want;
use crate::render::work::work_before;
use crate::toolpath::{Axes, Call, FeedMode, Place};

fn undefined<T>(number: f64) -> Done<T> {
    fault(
        Code::PR034,
        format!("the job has no subprogram {number}"),
        "add the subprogram to `subprograms`, before the operations",
    )
}

/// Replaces the location of a fault.
fn at<T>(place: Place, done: Done<T>) -> Done<T> {
    done.map_err(|diag: Box<Diag>| Box::new(diag.place(place)))
}

/// Prints a call. A subprogram moves the tool, so the known state is discarded before and after the call.
pub fn sub_call(call: &Call, cx: &mut Cx<'_>, subs: &mut Subprograms) -> Done {
    let shape = cx.shape;
    let from = subs.open;
    let mut unknown = VarSet::default();
    for var in CONDITIONS.into_iter().filter(|&var| cx.want.get(var).is_none()) {
        unknown.insert(var);
    }
    // a call from the main program needs no check at the end, because all subprograms that the call runs are already
    // known
    if let Some(from) = from {
        let turned_back = turns_back(cx.want, shape);
        subs.calls.push(Called { from, to: call.sub, place: cx.out.place, unknown, turned_back });
    }
    let Some(base) = shape.program.routine(SequenceId::SubCall) else {
        return fault(Code::PR008, "the form has no sequence SubCall", "add the sequence SubCall to the form");
    };
    let called = subs.index(call.sub);
    check_call(call, called, cx.want, cx.said, subs)?;
    if turns_back(cx.want, shape) && called.is_some_and(|called| subs.taps(called)) {
        return taps_back(call.sub);
    }
    let (printed, first_block) = names_of_called(call, called, shape, subs)?;
    let work = cx.want.get(VarId::Work);
    if let Some(work) = call.work {
        cx.want.set_work(work, shape)?;
    }
    let called_in = cx.want.get(VarId::Work);
    cx.said.stand.changes_work(work, called_in);
    let routine = shape.way(base, cx.want, cx.said);
    let place = go_to_call(call, routine, cx)?;
    cx.want.set(VarId::Sub, printed);
    cx.want.set(VarId::Times, call.times);
    cx.want.put(VarId::Subline, first_block);
    let routine = shape.way(base, cx.want, cx.said);
    let leaves = called.is_none_or(|i| subs.defined[i].calls_ahead || !subs.defined[i].left.is_nothing());
    // print the call once for each run if the sequence lacks `[times]`, or if each run must begin in the state of the
    // first run
    let together = routine.vars.has(VarId::Times) && !(leaves && call.times > 1.0);
    let calls = if together { 1 } else { call.times as u32 };
    if !together {
        cx.want.set(VarId::Times, 1.0);
    }
    let begins = if calls > 1 { next_begins(&place, routine, called, shape, cx.want, subs)? } else { place };
    for run in 0..calls {
        set_targets(if run == 0 { &place } else { &begins }, shape, cx.want, cx.said)?;
        let routine = shape.way(base, cx.want, cx.said);
        if run > 0 && leaves {
            knows_after_stop(shape, cx.want, cx.said)?;
            print_conditions(cx)?;
        }
        upons(routine.vars, cx)?;
        way_before(routine, &mut cx.writer())?;
        cx.said.forget_words();
        run_all(routine, &mut cx.writer())?;
        after_call(called, cx.want, cx.said, subs);
    }
    // the call's work offset applies to the call only: afterwards the operation's offset is active again
    cx.said.stand.changes_work(called_in, work);
    cx.want.put(VarId::Work, work);
    cx.want.changed = true;
    Ok(())
}

/// Refuses a call at which the subprogram would behave differently from its definition, for example with another feed
/// mode.
fn check_call(call: &Call, called: Option<usize>, want: &Want, said: &Said, subs: &Subprograms) -> Done {
    if want.feed_mode() != FeedMode::PerMinute {
        let help = "call the subprogram from an operation with feeds per minute";
        return fault(
            Code::PR033,
            "the feeds of a subprogram are per minute, but the feeds of its caller are not",
            help,
        );
    }
    if said.stand.angles.is_wound() {
        let help = "make the call before an axis is unwound, or first turn the axis back";
        return fault(
            Code::PR033,
            "a call after a rotary axis was unwound: the angles of the subprogram would be wrong",
            help,
        );
    }
    if call.work.is_some() && want.get(VarId::Work).is_none() {
        let help = "give the subprogram its own `work` before the call";
        return fault(
            Code::PR033,
            "a call in another work offset, but the work offset of the caller is unknown here",
            help,
        );
    }
    if call.times > 1.0 && called.is_some_and(|i| subs.defined[i].left.turned) {
        let help = "turn the part back at the end of the subprogram, or call it once for each angle";
        return fault(Code::PR033, "a subprogram that leaves the part turned is called several times", help);
    }
    Ok(())
}

/// The printed number of the called subprogram and, if known, the number of the subprogram's first block.
fn names_of_called(call: &Call, called: Option<usize>, shape: &Shape, subs: &Subprograms) -> Done<(f64, Option<f64>)> {
    let inside = subs.open.is_some();
    match called.map(|i| &subs.defined[i]) {
        Some(sub) => Ok((sub.printed, sub.first_block)),
        // a subprogram may call a later subprogram; the end of the job checks that the later subprogram exists
        None if inside && !shape.program.settings.renumber_subs => Ok((call.sub, None)),
        None if inside => {
            let help = "put the called subprogram before the calling one, or set `RenumSubs? N`";
            fault(Code::PR034, format!("subprogram {} is not known yet", call.sub), help)
        }
        None => undefined(call.sub),
    }
}

/// For a call whose runs are printed as separate calls: returns the start position of each run after the first. Each of
/// these runs starts at the end position of the previous run.
fn next_begins(
    place: &Axes,
    routine: &Routine,
    called: Option<usize>,
    shape: &Shape,
    want: &Want,
    subs: &Subprograms,
) -> Done<Axes> {
    // if the subprogram selects its own offset, its end position does not apply here
    let work =
        |conditions: &Conditions| conditions.get(VarId::Work).filter(|work| want.get(VarId::Work) != Some(*work));
    let left = called.map(|called| &subs.defined[called].left).filter(|left| work(&left.conditions).is_none());
    let mut begins = *place;
    for axis in (0..6).filter(|&axis| prints_axis(routine, axis, shape)) {
        let Some(at) = left.and_then(|left| left.position.get(axis)) else {
            let message = "a subprogram with an unknown end position is called several times, but `SubCall` prints a \
                position for each call";
            let help = "end the subprogram with a rapid to a position, or let `SubCall` print [times] and no position";
            return fault(Code::PR033, message, help);
        };
        begins.set(axis, at);
    }
    Ok(begins)
}

/// Whether the job requests that the spindle turns counterclockwise.
fn turns_back(want: &Want, shape: &Shape) -> bool {
    want.get(VarId::Direct) == Some(shape.program.settings.spindle[1])
}

fn taps_back<T>(sub: f64) -> Done<T> {
    let message =
        format!("subprogram {sub} taps right-hand threads, but its caller turns the spindle counterclockwise");
    fault(Code::PR033, message, "give the direction of the spindle in the subprogram before its tap")
}

/// Prints everything that must precede a call: changes that the call's sequence does not print, and the move to the
/// call's position. Returns the call's position.
fn go_to_call(call: &Call, routine: &Routine, cx: &mut Cx<'_>) -> Done<Axes> {
    let shape = cx.shape;
    plain_cutting(&mut cx.writer())?;
    let target = reach(&call.at, true, cx)?;
    set_targets(&target, shape, cx.want, cx.said)?;
    if cx.said.is_unsettled(cx.want) && !(says_work(routine, shape) && only_work_waits(shape, cx.want, cx.said)) {
        settle(cx)?;
    }
    let at = Axes { given: call.at.given, ..target };
    // the whole position is needed: a part of it could move the tool down before it moves across
    if (0..6).any(|axis| at.get(axis).is_some() && !prints_axis(routine, axis, shape)) {
        if says_work(routine, shape) {
            upons(VarSet::of(&[VarId::Work]), cx)?;
            work_before(&mut cx.writer())?;
        }
        if cx.said.turns(&at, shape) { turn_to(&at, cx)? } else { rapid_to(&at, cx)? }
    }
    set_targets(&target, shape, cx.want, cx.said)?;
    Ok(target)
}

/// Updates the known state after a call: the tool moved, and the subprogram's changes apply.
fn after_call(called: Option<usize>, want: &mut Want, said: &mut Said, subs: &mut Subprograms) {
    said.stand.fresh_tool = None;
    said.stand.has_height();
    said.beside.doubt();
    forget_where(want, said);
    let known = called.map(|i| &subs.defined[i]).filter(|sub| !sub.calls_ahead);
    match known {
        Some(sub) => {
            said.stand.left_at = sub.left.height;
            if sub.left.spins.stops {
                for var in [VarId::Speed, VarId::Direct, VarId::Cool] {
                    said.conditions.put(var, None);
                }
            }
            if let Some(open) = &mut said.sub {
                open.stops |= sub.left.spins.stops;
            }
            said.conditions = said.conditions.then(&sub.left.conditions);
            for (used, left) in said.upon_used.iter_mut().zip(&sub.left.upon_used) {
                *used = left.filter(|value| !value.is_nan()).or(*used);
            }
        }
        None => {
            said.conditions = Conditions::default();
            if let Some(open) = subs.open {
                subs.defined[open].calls_ahead = true;
            }
        }
    }
}

/// Checks that every called subprogram exists and that no subprogram calls itself.
pub fn check_calls(subs: &Subprograms) -> Done {
    let ends = subs.ending();
    for call in &subs.calls {
        let Some(to) = subs.index(call.to) else { return at(call.place, undefined(call.to)) };
        if subs.defined[to].left.conditions.known().meets(call.unknown) {
            let message = format!(
                "subprogram {} changes a setting that has no value in its caller, so the value can't be restored \
                 after the call",
                call.to
            );
            let help = "set spindle, coolant and work offset in the calling subprogram before the call";
            return at(call.place, fault(Code::PR033, message, help));
        }
        // the caller did not check the spindle and the coolant after the call of a later subprogram that contains a
        // stop
        let unknown = [VarId::Speed, VarId::Direct, VarId::Cool].into_iter().any(|var| call.unknown.has(var));
        if to > call.from && unknown && subs.defined[to].left.spins.stops {
            let message = format!(
                "subprogram {} contains a stop, but the spindle and coolant of its caller are unknown",
                call.to
            );
            let help = "set spindle and coolant in the calling subprogram before the call";
            return at(call.place, fault(Code::PR033, message, help));
        }
        if call.turned_back && subs.taps(to) {
            return at(call.place, taps_back(call.to));
        }
        if !ends[to] {
            let message = format!("subprogram {} calls itself, directly or through others", call.to);
            return at(call.place, fault(Code::PR033, message, "the program would never end: remove the call"));
        }
    }
    Ok(())
}
