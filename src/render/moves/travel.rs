//! Rotary axes with limited travel: unwinding.

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

/// Brings the rotary angles of a target into the travel of their axes. If an axis would leave its travel, the tool is
/// retracted and the axis is unwound. Later angles are measured from the new zero. `given`: the axes for which the
/// job's item gives a value. `free`: the tool is out of the part. Angles that differ by whole turns are then
/// equivalent.
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
            // the nearest equivalent angle within the travel
            let (raw, here) = (inside.values[axis], cx.said.stand.angle(axis).unwrap_or(0.0));
            let nearest = here + (raw - here + 180.0).rem_euclid(360.0) - 180.0;
            if let Some(angle) = [nearest, nearest - 360.0, nearest + 360.0].into_iter().find(|&a| within(a)) {
                cx.said.stand.angles.wind(axis, raw - angle);
                inside.values[axis] = angle;
                continue;
            }
        }
        // subtract whole turns from the axis' position, so that the move itself keeps its full angle
        let here = cx.said.stand.angle(axis).unwrap_or(0.0);
        let turns = here - here % 360.0;
        let angle = inside.values[axis] - turns;
        if turns == 0.0 || !within(angle) {
            let letter = char::from(letter);
            let message = format!("{letter}{angle} is beyond the travel from {} to {}", limit.least, limit.greatest);
            return fault(
                Code::PR007,
                message,
                "split the move, or turn in the opposite direction: unwinding does not help",
            );
        }
        unwind(axis, cx)?;
        cx.said.stand.angles.wind(axis, turns);
        inside.values[axis] = angle;
    }
    Ok(inside)
}

/// The target of a move, minus the whole turns that unwinding removed from its rotary axes.
pub fn unwound(target: &Axes, given: u8, shape: &Shape, said: &Said) -> Axes {
    let mut inside = *target;
    for axis in shape.rotary().filter(|axis| given & 1 << axis != 0) {
        inside.values[axis] -= said.stand.angles.wound(axis);
    }
    inside
}

/// Prints the Unwind sequence. Afterwards the tool is at its previous position, and the angle of the axis is reduced
/// modulo 360.
pub fn unwind(axis: usize, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    let letter = char::from(shape.axes[axis]);
    let Some(routine) = program.routine(SequenceId::Unwind) else {
        let message = format!("{letter} reaches the end of its travel, but the form has no sequence Unwind");
        return fault(
            Code::PR007,
            message,
            "add the sequence Unwind: it retracts the tool, turns the axis back and continues",
        );
    };
    if cx.want.compensated {
        let help = "end the compensation with an `outfeed` first";
        return fault(Code::PR030, "a rotary axis is unwound under cutter compensation", help);
    }
    if !prints_angle(routine, axis, shape) {
        let message = format!("{letter} must be unwound, but the sequence Unwind does not print its angle");
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

/// Runs a sequence that may move the tool away from the path and back. Afterwards only the values that the sequence
/// printed are known.
pub fn run_elsewhere(routine: &Routine, cx: &mut Cx<'_>) -> Done {
    cx.said.forget_words();
    cx.said.stand.placed = 0;
    run_with_upons(routine, cx)?;
    cx.said.say_motion_again();
    cx.said.last_move = LastMove::None;
    Ok(())
}
