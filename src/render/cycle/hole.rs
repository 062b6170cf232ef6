//! One hole: its position, the approach, and the code that prints it.

use super::choose::{cannot_say, scaled};
use super::generated::generated_hole;
use super::open::{Drilling, leave_cycle};
use super::plain::{NextHole, plain_hole, plain_words};
use super::planned::{Heights, Planned, SAME, hole_variables};
use super::sequence::sequence_hole;
use crate::compile::Routine;
use crate::cycle::Plan;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault, fault_at};
use crate::render::moves::prepare::stand_as_left;
use crate::render::moves::rapid_blocks::split_rapid;
use crate::render::moves::rotary::turn_to;
use crate::render::moves::travel::{in_travel, unwound};
use crate::render::prints::prints_axis;
use crate::render::said::Said;
use crate::render::settle::settle;
use crate::render::shape::{ROTARY_BITS, Shape};
use crate::render::targets::{check_limits, set_targets};
use crate::render::want::Want;
use crate::toolpath::{Axes, CycleKind, CycleSpec, FeedMode, Hole, impossible};

/// Error: the first point of a cycle has no height.
fn no_height<T>() -> Done<T> {
    fault(
        Code::PR006,
        "the first point of the cycle has no height",
        "give the third coordinate of the point, the top of the hole, as [1, 1, 0]",
    )
}

/// Handles a hole of the open cycle. If the form uses `[lasthole]`, the hole is held back until the next event.
pub fn hole(hole: &Hole, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    if let Some(words) = plain_words(hole, cx, drill) {
        return plain_hole(hole, &words, cx, drill);
    }
    if !shape.program.printed.with(shape.program.asked).has(VarId::Lasthole) {
        return make_hole(hole, cx, drill);
    }
    let place = cx.out.place;
    let Some(cycle) = &mut drill.open else { return impossible("a hole outside a cycle") };
    match cycle.held.replace((*hole, place)) {
        Some((before, at)) => {
            cx.out.place = at;
            let made = make_hole(&before, cx, drill);
            cx.out.place = place;
            made
        }
        None => Ok(()),
    }
}

/// Prints a hole, and the moves to it.
pub fn make_hole(hole: &Hole, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    let (scale, rpm) = (shape.scale, cx.want.get(VarId::Speed));
    let per_rev = cx.want.feed_mode() == FeedMode::PerRev;
    let point = hole.at.get(shape.depth).map(|d| d * scale);
    let Some(cycle) = &mut drill.open else { return impossible("a hole outside a cycle") };
    let mut planes = Plan::of(&cycle.spec, hole.depth.map(|d| d * scale), &shape.defaults, rpm)?;
    if per_rev {
        planes.lead = Some(planes.feed);
    }
    let starts = cycle.spec.starts.unwrap_or(1.0).max(1.0) as u32;
    let Some(point) = point.or(cycle.point) else { return no_height() };
    cycle.point = Some(point);
    let clear = point + planes.clear;
    // without a return plane the tool returns to the clearance of each hole
    let first = cycle.spec.return_height.map(|height| *cycle.return_plane.get_or_insert(point + height));
    let return_plane = first.map_or(clear, |first| first.max(clear));
    let heights = Heights { point, clear, bottom: point + planes.bottom, return_plane };
    let routine = cycle.sequence.and_then(|id| program.routine(id));
    let mut target = cx.said.stand.target(&hole.at, shape);
    if hole.at.given & ROTARY_BITS != 0 {
        if cx.said.turns(&unwound(&target, hole.at.given, shape, cx.said), shape) {
            leave_cycle(cx, drill)?; // must come before an axis is unwound
        }
        target = in_travel(&target, hole.at.given, true, cx)?;
    }
    target.set(shape.depth, heights.bottom);
    if !shape.program.settings.limits.is_empty() {
        check_limits(&target, shape)?;
    }
    target.set(shape.depth, heights.return_plane);
    for axis in (0..2).filter(|&axis| axis != shape.depth) {
        if target.get(axis).is_none() {
            return fault(Code::PR006, "the hole's position is unknown", "give both coordinates of the first point");
        }
    }
    let mut planned = Planned { target, planes, heights };
    let routine = match routine.filter(|routine| routine.flow.is_some()) {
        Some(routine) => {
            // conditions of the sequence may depend on the hole
            set_targets(&target, shape, cx.want, cx.said)?;
            hole_variables(&planned, shape, cx.want, drill);
            let way = shape.way(routine, cx.want, cx.said);
            says_the_hole(way, drill, shape)?;
            Some(way)
        }
        None => routine,
    };
    let lost = routine.is_some_and(|routine| sequence_loses(routine, &target, shape, cx.said));
    if cx.said.turns(&target, shape) || lost {
        // a cycle can't turn the part: leave the cycle, index or move, then start the cycle again
        leave_cycle(cx, drill)?;
        set_targets(&target, shape, cx.want, cx.said)?;
        if cx.said.is_unsettled(cx.want) {
            settle(cx)?;
        }
        match program.routine(SequenceId::Index).filter(|_| cx.said.turns(&target, shape)) {
            Some(_) => turn_to(&target, cx)?,
            None => split_rapid(&target, cx)?,
        }
    }
    if cx.said.stand.left_hole.is_some() {
        // the tool can come from a hole of another cycle only if this hole is the first of its cycle
        if drill.open.as_ref().is_some_and(|cycle| cycle.holes == 0) {
            stand_as_left(&target, true, cx)?;
        } else {
            cx.said.stand.left_hole = None;
        }
    }
    cx.said.stand.moved_by = None; // rapids approach every hole
    match routine {
        Some(routine) => {
            for start in 0..starts {
                planned.heights = heights.of_start(start, starts, &planned.planes)?;
                planned.target.set(shape.depth, planned.heights.return_plane);
                sequence_hole(routine, &planned, cx, drill)?;
            }
            if planned.heights.return_plane < heights.return_plane - SAME {
                // the last start of a thread ends lower than the return plane: raise the tool before it moves across
                leave_cycle(cx, drill)?;
                split_rapid(&target, cx)?;
            }
        }
        None => generated_hole(&planned, cx, drill)?,
    }
    cx.said.stand.has_height();
    if let Some(cycle) = &mut drill.open {
        cycle.holes += 1;
        cycle.depth = hole.depth;
        if let NextHole::Position(_) = cycle.next {
            cycle.next = NextHole::Unknown;
        }
        // a manual cycle leaves the tool where it stopped
        cycle.left = (cycle.spec.kind != CycleKind::Manual).then_some(heights.return_plane);
    }
    Ok(())
}

/// Checks that the selected branches of a sequence print everything that the cycle requests.
fn says_the_hole(way: &Routine, drill: &Drilling, shape: &Shape) -> Done {
    let Some(what) = drill.open.as_ref().and_then(|cycle| cannot_say(&cycle.spec, way, shape)) else { return Ok(()) };
    let message = format!("a branch of the sequence does not print {what}");
    fault_at(Code::PR017, message, "print the value in every branch", Some(way.span))
}

/// Whether the hole needs a position perpendicular to the tool axis that its sequence does not print. An example is a
/// hole on a lathe.
fn sequence_loses(routine: &Routine, target: &Axes, shape: &Shape, said: &Said) -> bool {
    let mut across = (0..2).filter(|&axis| axis != shape.depth);
    across.any(|axis| target.get(axis) != said.stand.position.get(axis) && !prints_axis(routine, axis, shape))
}

/// The planes of a cycle at a hole.
fn planes_at(spec: &CycleSpec, hole: &Hole, shape: &Shape, want: &Want) -> Done<Plan> {
    let depth = hole.depth.map(|d| d * shape.scale);
    Ok(Plan::of(spec, depth, &shape.defaults, want.get(VarId::Speed))?)
}

/// The tool position before the first hole of a cycle: over the hole, at the return plane. Tool changes use this
/// position.
pub fn hole_position(spec: &CycleSpec, hole: &Hole, shape: &Shape, want: &Want, said: &Said) -> Done<Axes> {
    let spec = scaled(spec, shape);
    let planes = planes_at(&spec, hole, shape, want)?;
    let mut target = said.stand.target(&hole.at, shape);
    let Some(point) = hole.at.get(shape.depth) else { return no_height() };
    let point = point * shape.scale;
    target.set(shape.depth, point + spec.return_height.unwrap_or(planes.clear).max(planes.clear));
    Ok(target)
}
