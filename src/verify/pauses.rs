//! Compares stops and dwells between cuts. The program must have the stops and dwells of the job, at positions where the
//! tool may stop. Other stops and dwells are allowed only outside cuts.

use super::beside::Mark;
use super::cut::{ACROSS, ALL, DEPTH, Rapid, number, same, same_dwell};
use super::intent::Expected;
use super::passage::Passage;
use super::rapids;
use super::sides::Sides;
use super::tables::STARTED;
use crate::diag::Code;
use crate::toolpath::StopKind;

/// Compares the stops and dwells since the last cut.
pub(super) fn compare(s: &mut Sides<'_>) {
    let passage = &s.program.passage;
    let nothing = [&s.job, passage].into_iter().all(|side| side.stops.is_empty() && side.waits.is_empty());
    if nothing && (s.tools || !s.job.new_tool) {
        return;
    }
    stops(s);
    waits(s);
}

fn kind_of(kind: StopKind) -> &'static str {
    if kind == StopKind::Program { "program" } else { "optional" }
}

/// Checks that the program has the job's stops in the job's order, with the tool at the job's height or higher.
fn stops(s: &mut Sides<'_>) {
    let tolerance = s.limits.tolerance;
    let mut others = s.program.passage.stops.clone();
    operators_change(s, &mut others);
    let wanted = std::mem::take(&mut s.job.stops);
    let mut from = 0;
    for stop in &wanted {
        let Some(at) = others[from..].iter().position(|other| other.what == stop.what) else {
            told(s, stop, Code::PV019, 0, "print M0 or M1", || {
                format!("the job's {} stop is missing", kind_of(stop.what))
            });
            continue;
        };
        let made = others.remove(from + at);
        from += at;
        let away = rapids::away(s.machine);
        if s.job.at_home(stop, away) && !s.program.passage.at_home(&made, away) {
            told(s, stop, Code::PV019, made.line, "print the stop after the move home", || {
                "the job stops with the tool at home, but the program stops before the move home".to_owned()
            });
        }
        s.report.allowed.pauses += u64::from(is_elsewhere(s, stop, &made));
        if let (Some(a), Some(b)) = (s.job.height_at(stop), s.program.passage.height_at(&made))
            && b.height < a.height - tolerance
            && a.height.is_finite()
        {
            let [a, b] = [a, b].map(|standing| number(standing.height));
            told(s, stop, Code::PV019, made.line, "retract before the stop", || {
                format!("the program stops with the tool at Z{b}, but the job at Z{a}")
            });
        }
    }
    for stop in &others {
        let passage = &s.program.passage;
        let in_cut = passage.in_cut(stop, tolerance) || s.hole.holds(passage, stop, tolerance);
        own_stop(s, stop, in_cut);
    }
}

/// Checks stops between two pecks of a hole. No job has a stop between two pecks. A stop below the clearance plane
/// counts as a stop in a cut.
pub(super) fn between_pecks(s: &mut Sides<'_>, hole: &Expected) {
    for stop in s.program.passage.stops.clone() {
        let stands = s.program.passage.standing(&stop);
        let is_out = stands.is_some_and(|at| at.to[DEPTH] >= hole.plane - s.limits.tolerance);
        own_stop(s, &stop, !is_out && !hole.custom);
    }
}

/// Handles a stop that the job does not have. A stop in a cut is a finding; a stop outside cuts is counted as an
/// allowed difference.
fn own_stop(s: &mut Sides<'_>, stop: &Mark<StopKind>, in_cut: bool) {
    if !in_cut {
        s.report.allowed.stops += 1;
        return;
    }
    s.found(Code::PV019, stop.line, "retract before the stop, or remove the stop", || {
        "the program stops with the tool in the cut, but the job does not stop here".to_owned()
    });
}

/// Whether the tool's position at the job's mark differs from its position at the program's mark.
fn is_elsewhere<T>(s: &Sides<'_>, wanted: &Mark<T>, made: &Mark<T>) -> bool {
    let stands = [s.job.standing(wanted), s.program.passage.standing(made)];
    matches!(stands, [Some(a), Some(b)] if !same(&a.to, &b.to, ALL, s.limits.tolerance))
}

/// On a machine without tool changes, the program stops before each new tool. Such a stop for a tool comes after the
/// job's stops with the previous tool.
fn operators_change(s: &mut Sides<'_>, others: &mut Vec<Mark<StopKind>>) {
    if !s.job.new_tool || s.tools || s.switches {
        return;
    }
    let count = |stops: &[Mark<StopKind>]| stops.iter().filter(|stop| stop.what == StopKind::Program).count();
    let changes = s.job.tool_changes();
    for (number, (leg, is_first)) in changes.iter().enumerate() {
        let later = changes.len() - number - 1;
        if *is_first && count(others) <= count(&s.job.stops) + later {
            continue; // the first tool may already be in the spindle
        }
        let before = s.job.stops_before(*leg, StopKind::Program);
        let mut stops = others.iter().enumerate().filter(|(_, stop)| stop.what == StopKind::Program);
        match stops.nth(before).map(|(at, _)| at) {
            Some(at) => {
                let stop = others.remove(at);
                s.program.passage.split(&stop);
            }
            None if !is_first => s.found(Code::PV012, 0, "print M0 in the tool change", || {
                "the program continues without a stop for the next tool".to_owned()
            }),
            None => {}
        }
    }
}

/// Reports a difference at the item of the job that made the mark.
fn told<T>(s: &mut Sides<'_>, mark: &Mark<T>, code: Code, line: u64, help: &'static str, message: impl Fn() -> String) {
    let here = std::mem::replace(&mut s.report.place, mark.place);
    s.found(code, line, help, message);
    s.report.place = here;
}

/// Checks that the program has the job's dwells. Additional dwells are allowed only outside cuts, or while the spindle
/// comes to speed.
fn waits(s: &mut Sides<'_>) {
    let tolerance = s.limits.tolerance;
    let mut wanted = std::mem::take(&mut s.job.waits);
    // dwells of any length are matched last
    wanted.sort_by_key(|wait| wait.what.is_nan());
    let mut others = s.program.passage.waits.clone();
    // the tool or work offset may have changed since the hole
    let holes = [s.hole.last, s.hole.before];
    let fed_out = s.job.start.is_some_and(|start| {
        holes
            .iter()
            .flatten()
            .filter(|hole| hole.feeds_out || hole.is_tap)
            .any(|hole| same(&start.to, &hole.at, ACROSS, tolerance) && start.to[DEPTH] >= hole.plane - tolerance)
    });
    let start = s.job.start;
    let is_over = |at: &Rapid| {
        start.is_some_and(|start| {
            same(&at.to, &start.to, ACROSS, tolerance) && at.to[DEPTH] >= start.to[DEPTH] - tolerance
        })
    };
    let is_one = |wanted: f64, is: f64| wanted.is_nan() || same_dwell(wanted, is);
    for wait in &wanted {
        let in_cut = s.job.in_cut(wait, tolerance);
        let hole = &s.hole;
        let serves = |passage: &Passage, other: &Mark<f64>| match (in_cut, passage.in_cut(other, tolerance)) {
            (true, true) => true,
            (false, is) if is || hole.holds(passage, other, tolerance) => {
                match (s.job.standing(wait), passage.standing(other)) {
                    // the tool must already be at the job's position
                    (Some(a), Some(b)) => {
                        same(&a.to, &b.to, ACROSS, tolerance) && b.to[DEPTH] >= a.to[DEPTH] - tolerance
                    }
                    _ => false,
                }
            }
            (false, _) => true,
            // after the tool leaves a hole at feed, it may dwell farther up
            (true, false) => fed_out && passage.standing(other).is_some_and(|at| is_over(&at)),
        };
        let passage = &s.program.passage;
        let there = others.iter().position(|other| serves(passage, other) && is_one(wait.what, other.what));
        if let Some(at) = there {
            let made = others.remove(at);
            s.report.allowed.pauses += u64::from(!in_cut && is_elsewhere(s, wait, &made));
            continue;
        }
        if wait.what.is_nan() {
            continue;
        }
        // a dwell for the spindle to come to speed does not replace a dwell of the job, except in a hole
        let may_be = |other: &Mark<f64>| !other.started || hole.holds(passage, other, tolerance);
        let another = others.iter().position(|other| serves(passage, other) && may_be(other));
        let seconds = number(wait.what);
        match another.map(|at| others.remove(at)) {
            Some(other) => told(s, wait, Code::PV010, other.line, "check the unit of the dwell (`Dwell`)", || {
                format!("the dwell is {} s, but {seconds} s in the job", number(other.what))
            }),
            None => told(s, wait, Code::PV010, 0, "check the dwell of the cycle or block", || {
                format!("the dwell of {seconds} s is missing")
            }),
        }
    }
    // at the bottom of a hole whose moves only the form defines
    let own = holes.into_iter().flatten().any(|last| {
        last.custom && s.program.passage.start.is_some_and(|start| same(&start.to, &last.at, ACROSS, tolerance))
    });
    let mut started = false;
    for other in &others {
        let passage = &s.program.passage;
        let in_hole = s.hole.holds(passage, other, tolerance);
        // after the tool leaves a hole at feed, it is not in a cut
        let in_cut = s.hole.inside.is_none() && passage.in_cut(other, tolerance);
        // a torch may dwell once to pierce, a spindle once to come to speed
        let burns = s.switches && !other.is_off;
        let once = other.what <= STARTED && !started;
        started |= burns || in_cut;
        if !in_hole && (own || other.started && in_cut && once || !in_cut && (!burns || once)) {
            s.report.allowed.dwells += 1;
            continue;
        }
        let seconds = number(other.what);
        let help = "remove the dwell, or retract first; P is modal in a cycle: print P0";
        s.found(Code::PV010, other.line, help, || format!("a dwell of {seconds} s that the job does not have"));
    }
}
