//! Moves the tool to the home position of the machine.

use super::stops::settle_between_moves;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::targets::set_here;
use crate::render::upon::run_with_upons;
use crate::render::vars::NOW;
use crate::toolpath::Axes;

/// Prints the form's MoveHome sequence. Only the form defines the home position, so the tool's position is unknown
/// afterwards.
pub fn home(cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    if cx.want.compensated {
        let help = "end the compensation with an `outfeed` first";
        return fault(Code::PR030, "the tool goes home under cutter compensation", help);
    }
    if shape.program.routine(SequenceId::MoveHome).is_none() {
        let message = "the tool goes home here, but the form has no sequence `MoveHome`";
        let help = "add `MoveHome` with the words of the control, as `G28 G91 Z0.` and `G90`, and `End`";
        return fault(Code::PR008, message, help);
    }
    settle_between_moves(cx)?;
    set_here(shape, cx.want, cx.said)?;
    let Some(routine) = shape.routine(SequenceId::MoveHome, cx.want, cx.said) else { return Ok(()) };
    run_with_upons(routine, cx)?;
    let known = cx.said.stand.fresh_tool.unwrap_or(0) | cx.said.stand.position.given;
    cx.said.stand.fresh_tool = Some(known);
    cx.said.stand.angles.keep(&cx.said.stand.position);
    cx.said.forget_axes(shape);
    cx.said.forget_place();
    cx.want.forget(&[VarId::H, VarId::V, VarId::D]);
    cx.said.from_home = shape.program.routine(SequenceId::AfterHome).is_some();
    cx.said.differs |= cx.said.from_home; // so that the next rapid is not printed as a plain rapid
    Ok(())
}

/// Prints the form's AfterHome sequence: after a move to the home position, before the first rapid that has a height.
pub fn after_home(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    cx.said.from_home = false;
    let mut whole = cx.said.stand.position;
    for axis in (0..6).filter(|axis| target.given & 1 << axis != 0) {
        whole.set(axis, target.values[axis]);
    }
    // the rapid may be a part of a cycle, whose variables are used after it
    let kept = NOW.map(|var| cx.want.get(var));
    for (axis, var) in NOW.into_iter().enumerate() {
        cx.want.put(var, whole.get(axis).map(|value| value * shape.scales[axis]));
    }
    if let Some(routine) = shape.routine(SequenceId::AfterHome, cx.want, cx.said) {
        run_with_upons(routine, cx)?;
    }
    for (var, value) in NOW.into_iter().zip(kept) {
        cx.want.put(var, value);
    }
    Ok(())
}
