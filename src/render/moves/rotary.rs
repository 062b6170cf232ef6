//! Rapids that turn the part.

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

/// Prints a rapid that turns the part. If the form has an Index sequence, this sequence prints the rapid.
pub fn turn_to(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let Some(routine) = shape.routine(SequenceId::Index, cx.want, cx.said) else {
        return rapid_to(target, cx);
    };
    if let Some(axis) = cx.said.turned_axes(target, shape).find(|&axis| !prints_angle(routine, axis, shape)) {
        let letter = char::from(shape.axes[axis]);
        let message = format!("{letter} turns to {}, but the sequence Index does not print it", target.values[axis]);
        return fault_at(Code::PR017, message, format!("add `{letter}[rotangle]` to Index"), Some(routine.span));
    }
    // an Index that does not raise the tool itself would turn the part under the tool
    if target.get(shape.depth).is_some()
        && !prints_axis_words(routine, true, shape)
        && is_below(target, shape, cx.said)?
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
        // over the hole first, then down
        _ if cx.want.cycle.is_some() => split_rapid(&left, cx),
        _ => rapid_to(&left, cx),
    }
}

/// Checks a sequence that moves the tool down: it must also print all other axes of the target.
fn sequence_goes_down(routine: &Routine, target: &Axes, shape: &Shape, said: &Said) -> Done {
    if routine.vars.has(VarId::D) { check_prints(routine, target, shape, said) } else { Ok(()) }
}

/// The target of a tool change. The target contains a rotary axis only if the tool change sequence has a word for this
/// axis. A tool change that moves down must have words for the rotary axes; otherwise the part would turn into the
/// tool.
pub fn change_turns(routine: &Routine, target: &Axes, given: u8, cx: &mut Cx<'_>) -> Done<Axes> {
    let shape = cx.shape;
    let down = routine.steps().find(|&i| matches!(shape.program.ops[i], Op::Var { var: VarId::D, .. }));
    let before = Routine { ops: routine.ops.start..down.unwrap_or(routine.ops.end), ..routine.clone() };
    let says = |axis: &usize| prints_angle(&before, *axis, shape);
    let lost = cx.said.turned_axes(target, shape).find(|axis| !says(axis));
    if let Some(axis) = lost.filter(|_| routine.vars.has(VarId::D)) {
        let (letter, angle) = (char::from(shape.axes[axis]), target.values[axis]);
        let message =
            format!("the tool begins at {letter}{angle}, but the tool change goes down before the part turns");
        let help = format!("print `{letter}[rotangle]` in the tool change, before the height");
        return fault_at(Code::PR017, message, help, Some(routine.span));
    }
    let unsaid = shape.rotary().filter(|axis| !says(axis)).fold(0, |axes, axis| axes | 1 << axis);
    // only the axes of the first move, because a new tool keeps no position
    let target = Axes { given: given & !unsaid, ..*target };
    in_travel(&target, given & !unsaid, true, cx)
}

/// Handles a tilted tool axis, which is an error: a form has words for rotary angles, but can't calculate these angles
/// from a tool axis vector.
pub fn tilt(axis: [f64; 3]) -> Done {
    if axis == [0.0, 0.0, 1.0] {
        return Ok(());
    }
    let [i, j, k] = axis;
    let message = format!("the tool is tilted to {i:.6}, {j:.6}, {k:.6}: forms can't print a tilted tool");
    fault(
        Code::PR008,
        message,
        "select one setup of a CL file with `--setup N` (`check` lists them), or render only the parts with an \
         upright tool",
    )
}
