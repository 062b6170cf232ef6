//! The position variables (target and start of a move), and the travel limits.

use super::fault::{Done, fault_at};
use super::numbers::as_number;
use super::said::Said;
use super::shape::{ROTARY_BITS, Shape};
use super::vars::{MOVED, NOW};
use super::want::Want;
use crate::diag::Code;
use crate::lang::VarId;
use crate::number::quantise;
use crate::toolpath::Axes;

/// Sets the variables of a target and of the position before the target.
#[inline]
pub fn set_targets(target: &Axes, shape: &Shape, want: &mut Want, said: &mut Said) -> Done {
    const UPPER: [VarId; 2] = [VarId::H2, VarId::V2];
    const LAST: [VarId; 3] = [VarId::Lasth, VarId::Lastv, VarId::Lastd];
    if shape.linear == 4 {
        for (axis, var) in (2..4).zip(UPPER) {
            want.put(var, target.get(axis));
        }
    }
    for axis in 0..shape.linear.min(if shape.linear == 4 { 2 } else { 3 }) {
        let bit = 1 << axis;
        if target.given & bit == 0 {
            continue;
        }
        said.stand.aims(bit);
        let value = target.values[axis] * shape.scales[axis];
        want.set(NOW[axis], value);
        if said.stand.position.given & bit != 0 {
            let before = said.stand.position.values[axis] * shape.scales[axis];
            want.set(LAST[axis], before);
            want.set(MOVED[axis], as_printed(axis, value, shape) - as_printed(axis, before, shape));
        } else {
            want.put(MOVED[axis], None);
        }
    }
    if target.given & ROTARY_BITS != 0 {
        set_angles(target, shape, want, said);
    }
    if !shape.program.settings.limits.is_empty() {
        check_limits(target, shape)?;
    }
    Ok(())
}

/// A value rounded to the digits of its axis, so that distances between positions add up exactly.
#[inline]
fn as_printed(axis: usize, value: f64, shape: &Shape) -> f64 {
    let decimals = shape.letters[shape.axes[axis]].format.dec.count;
    quantise(value, decimals).map_or(value, |units| as_number(units, decimals))
}

/// Sets the position variables to the tool's position, for a sequence between moves.
pub fn set_here(shape: &Shape, want: &mut Want, said: &mut Said) -> Done {
    let here = said.stand.position;
    if shape.sets_targets { Ok(()) } else { set_targets(&here, shape, want, said) }
}

/// Sets the variables of a target's rotary angles.
#[cold]
fn set_angles(target: &Axes, shape: &Shape, want: &mut Want, said: &mut Said) {
    for axis in shape.rotary() {
        let Some(to) = target.get(axis) else { continue };
        let from = said.stand.angle(axis);
        said.stand.angles.turn(axis, from, to);
        if from == Some(to) {
            continue;
        }
        want.put(VarId::Lastrotangle, from);
        want.set(VarId::Rotangle, to);
        // up to half a turn the job's angles define the direction; for larger angles the shorter direction applies
        let way = from.map(|from| match to - from {
            way if way.abs() <= 180.0 => way,
            way => (way + 180.0).rem_euclid(360.0) - 180.0,
        });
        want.put(VarId::Rotaxdir, way.map(|way| if way < 0.0 { -1.0 } else { 1.0 }));
    }
}

/// Checks the travel limits of the form.
#[cold]
pub fn check_limits(target: &Axes, shape: &Shape) -> Done {
    for limit in &shape.program.settings.limits {
        let Some(axis) = shape.axes.iter().position(|&letter| letter == limit.letter) else { continue };
        let Some(value) = target.get(axis).map(|value| value * shape.scales[axis]) else { continue };
        let scale = if axis < shape.linear { shape.form_scale } else { 1.0 };
        let (least, greatest) = (limit.least * scale, limit.greatest * scale);
        if value < least || value > greatest {
            let letter = char::from(limit.letter);
            let message = format!("{letter}{value:.4} is beyond the travel from {least} to {greatest}");
            return fault_at(Code::PR007, message, "move the part, or fix `Limits` in the form", Some(limit.span));
        }
    }
    Ok(())
}
