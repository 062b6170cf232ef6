//! Another view of the part: rapids that turn it.

use super::rapid_blocks::{is_below, raise, rapid_to, split_rapid};
use super::travel::{in_travel, run_elsewhere};
use crate::compile::{Op, Routine};
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault, fault_at};
use crate::render::prelude::check_prints;
use crate::render::prints::{prints_angle, prints_axis_words};
use crate::render::said::Said;
use crate::render::shape::Shape;
use crate::toolpath::Axes;

/// A rapid to another rotary view: Index, where the form has it.
pub fn turn_to(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let Some(routine) = shape.routine(SequenceId::Index, cx.want, cx.said) else {
        return rapid_to(target, cx);
    };
    if let Some(axis) = cx.said.turned_axes(target, shape).find(|&axis| !prints_angle(routine, axis, shape)) {
        let letter = char::from(shape.axes[axis]);
        let message = format!("{letter} turns to {}, which Index does not print", target.values[axis]);
        return fault_at(Code::PR017, message, format!("add `{letter}[rotangle]` to Index"), Some(routine.span));
    }
    // one that does not take the tool up itself would turn the part under it
    if target.get(shape.depth).is_some() && !prints_axis_words(routine, true, shape) && is_below(target, shape, cx.said)
    {
        raise(target, cx)?;
    }
    sequence_goes_down(routine, target, shape, cx.said)?;
    run_elsewhere(routine, cx)?;
    let placed = cx.said.stand.placed;
    cx.said.stand.move_to(&Axes { given: target.given & placed, ..*target });
    let left = Axes { given: target.given & !placed, ..*target };
    match left.given {
        0 => Ok(()),
        // over a hole first, down last
        _ if cx.want.cycle.is_some() => split_rapid(&left, cx),
        _ => rapid_to(&left, cx),
    }
}

/// A sequence that goes down must first go everywhere else that the target says.
fn sequence_goes_down(routine: &Routine, target: &Axes, shape: &Shape, said: &Said) -> Done {
    if routine.vars.has(VarId::D) { check_prints(routine, target, shape, said) } else { Ok(()) }
}

/// What a tool change prints of its first target: rotary axes only where it has a word for them. One that goes
/// down must have it: else the part would turn against the tool.
pub fn change_turns(routine: &Routine, target: &Axes, given: u8, cx: &mut Cx<'_>) -> Done<Axes> {
    let shape = cx.shape;
    let down = routine.steps().find(|&i| matches!(shape.program.ops[i], Op::Var { var: VarId::D, .. }));
    let before = Routine { ops: routine.ops.start..down.unwrap_or(routine.ops.end), ..routine.clone() };
    let says = |axis: &usize| prints_angle(&before, *axis, shape);
    let lost = cx.said.turned_axes(target, shape).find(|axis| !says(axis));
    if let Some(axis) = lost.filter(|_| routine.vars.has(VarId::D)) {
        let (letter, angle) = (char::from(shape.axes[axis]), target.values[axis]);
        let message =
            format!("the tool begins at {letter}{angle}, and the tool change goes down before the part turns");
        let help = format!("print `{letter}[rotangle]` in the tool change, before the height");
        return fault_at(Code::PR017, message, help, Some(routine.span));
    }
    let unsaid = shape.rotary().filter(|axis| !says(axis)).fold(0, |axes, axis| axes | 1 << axis);
    // only what the first move gives: another tool keeps no position
    let target = Axes { given: given & !unsaid, ..*target };
    in_travel(&target, given & !unsaid, true, cx)
}

/// The job tilts the tool. A form has words for rotary axes, not for the kinematics that a vector needs.
pub fn tilt(axis: [f64; 3]) -> Done {
    if axis == [0.0, 0.0, 1.0] {
        return Ok(());
    }
    let [i, j, k] = axis;
    let message = format!("the tool is tilted to {i:.6}, {j:.6}, {k:.6}, and a form has no words for that");
    fault(
        Code::PR008,
        message,
        "take one setup of a CL file by `--setup N` (`check` lists them), or render the parts that keep the tool upright",
    )
}
