//! Rotary travel that ends: axes are unwound.

use crate::compile::Routine;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault, fault_at};
use crate::render::prints::prints_angle;
use crate::render::said::{LastMove, Said};
use crate::render::shape::Shape;
use crate::render::targets::set_targets;
use crate::render::upon::run_with_upons;
use crate::toolpath::Axes;

/// A target whose rotary angles are in the travel of their axes: when one would leave it, the tool is taken out,
/// the axis unwound, and angles count from there. `given`: the axes that the job's own item gives. `free`: the tool is
/// out of the part, so whole turns more or less are the same view.
pub fn in_travel(target: &Axes, given: u8, free: bool, cx: &mut Cx<'_>) -> Done<Axes> {
    let shape = cx.shape;
    let mut inside = *target;
    for axis in shape.rotary().filter(|axis| given & 1 << axis != 0) {
        let letter = shape.axes[axis];
        shape.needs_axis(letter)?;
        inside.values[axis] = target.values[axis] - cx.said.stand.angles.wound(axis);
        let Some(limit) = shape.program.settings.limits.iter().find(|limit| limit.letter == letter) else {
            continue;
        };
        let free = free
            && (cx.said.stand.angles.wound(axis) != 0.0
                || !(limit.least..=limit.greatest).contains(&inside.values[axis]));
        let within = |angle: f64| (limit.least..=limit.greatest).contains(&angle);
        if within(inside.values[axis]) && !free {
            continue;
        }
        if free {
            // the nearest of the same views that the axis can reach
            let (raw, here) = (inside.values[axis], cx.said.stand.angle(axis).unwrap_or(0.0));
            let nearest = here + (raw - here + 180.0).rem_euclid(360.0) - 180.0;
            if let Some(angle) = [nearest, nearest - 360.0, nearest + 360.0].into_iter().find(|&a| within(a)) {
                cx.said.stand.angles.wind(axis, raw - angle);
                inside.values[axis] = angle;
                continue;
            }
        }
        // whole turns come off where the axis stands, so that the move itself turns as far as it should
        let here = cx.said.stand.angle(axis).unwrap_or(0.0);
        let turns = here - here % 360.0;
        let angle = inside.values[axis] - turns;
        if turns == 0.0 || !within(angle) {
            let letter = char::from(letter);
            let message = format!("{letter}{angle} is beyond the travel from {} to {}", limit.least, limit.greatest);
            return fault(
                Code::PR007,
                message,
                "split the move, or turn the other way: no unwinding brings it into the travel",
            );
        }
        unwind(axis, cx)?;
        cx.said.stand.angles.wind(axis, turns);
        inside.values[axis] = angle;
    }
    Ok(inside)
}

/// A target less the whole turns that were taken off.
pub fn unwound(target: &Axes, given: u8, shape: &Shape, said: &Said) -> Axes {
    let mut inside = *target;
    for axis in shape.rotary().filter(|axis| given & 1 << axis != 0) {
        inside.values[axis] -= said.stand.angles.wound(axis);
    }
    inside
}

/// Prints Unwind; the tool is back where it was, its angle modulo 360.
pub fn unwind(axis: usize, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    let letter = char::from(shape.axes[axis]);
    let Some(routine) = program.routine(SequenceId::Unwind) else {
        let message = format!("{letter} reaches the end of its travel, and the form has no Unwind");
        return fault(Code::PR007, message, "add Unwind: it lifts the tool, turns the axis back and goes on");
    };
    if cx.want.compensated {
        let help = "end the compensation with an `outfeed` before";
        return fault(Code::PR030, "a rotary axis is unwound under cutter compensation", help);
    }
    if !prints_angle(routine, axis, shape) {
        let message = format!("{letter} is to be unwound, and Unwind does not print its angle");
        return fault_at(Code::PR017, message, format!("print `{letter}[lastrotangle]`"), Some(routine.span));
    }
    let mut here = cx.said.stand.position;
    here.set(axis, cx.said.stand.angle(axis).unwrap_or(0.0) % 360.0);
    set_targets(&here, shape, cx.want, cx.said)?;
    for (var, now) in [(VarId::Lasth, 0), (VarId::Lastv, 1), (VarId::Lastd, 2)] {
        cx.want.put(var, here.get(now));
    }
    cx.said.stand.angles.was(axis, here.get(axis));
    cx.want.put(VarId::Lastrotangle, here.get(axis));
    let routine = shape.way(routine, cx.want, cx.said);
    run_elsewhere(routine, cx)?;
    cx.said.stand.position.set(axis, here.values[axis]);
    Ok(())
}

/// A sequence that may leave the path and come back: only what it prints is known afterwards.
pub fn run_elsewhere(routine: &Routine, cx: &mut Cx<'_>) -> Done {
    cx.said.forget_words();
    cx.said.stand.placed = 0;
    run_with_upons(routine, cx)?;
    cx.said.say_motion_again();
    cx.said.last_move = LastMove::None;
    Ok(())
}
