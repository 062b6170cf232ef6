//! Warnings about cycle values that are missing or contradictory, but are not errors.

use super::planned::SAME;
use crate::cycle::rounded;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::render::printer::Printer;
use crate::render::shape::Shape;
use crate::render::want::Want;
use crate::toolpath::{CycleKind, CycleSpec};

/// Warns of cycle values that are missing or contradictory, but are not errors.
pub fn warn_of(spec: &CycleSpec, sequence: Option<SequenceId>, shape: &Shape, want: &Want, out: &mut Printer) {
    let pecks = matches!(spec.kind, CycleKind::Deep | CycleKind::Chipbreak);
    if pecks && spec.step.or(shape.defaults.step).is_none() && spec.pecks.is_empty() {
        let message = format!("`{}` has no step and drills in one peck", spec.kind.name());
        out.note(Code::PC060, message, "give the cycle a `step`, or the form a `CycleStep`");
    }
    let clear = spec.clear.unwrap_or(shape.defaults.clear);
    // if the first point is above the return plane, the tool returns to the clearance of the point, which is no
    // contradiction
    if let Some(height) = spec.return_height.filter(|height| (0.0..clear - SAME).contains(height)) {
        let [height, clear] = [height, clear].map(rounded);
        let message = format!("the return plane, {height} above the point, is below the clearance, {clear}");
        out.note(Code::PC053, message, "the clearance is used: give `return` above `clear`, or leave it out");
    }
    let [cw, ccw, _] = shape.program.settings.spindle;
    let needed = if spec.kind == CycleKind::LTap { ccw } else { cw };
    if spec.kind.is_tap() && want.get(VarId::Direct).is_some_and(|code| code != needed && [cw, ccw].contains(&code)) {
        let (name, turns) = (spec.kind.name(), cw + ccw - needed);
        let message = format!("a `{name}` with the spindle in M{turns}: the direction is reversed for the tap");
        out.note(
            Code::PC054,
            message,
            "give the direction of the spindle in the job, or use the tap for the other direction",
        );
    }
    if spec.back.is_some()
        && sequence
            .and_then(|id| shape.program.routine(id))
            .is_some_and(|routine| !routine.vars.has(VarId::Sclear) && !routine.vars.has(VarId::Vleave))
    {
        let message = "the control uses its own setting instead of `back`, the retract between pecks";
        out.note(Code::PR021, message.into(), "set the retract at the control, or print [vleave] in the cycle");
    }
    let printed =
        sequence.and_then(|id| shape.program.routine(id)).is_some_and(|routine| routine.vars.has(VarId::Vbite));
    if spec.kind.is_tap() && spec.mode.is_none() && spec.step.is_some() && !printed {
        let message = "`step` has no effect, because this tap does not peck";
        let help = match sequence {
            Some(id) => {
                format!("print `Q[vbite]` in the sequence `{}` if the control's tap pecks, or remove `step`", id.name())
            }
            None => "give the kind of pecks with `mode`, or remove `step`".to_owned(),
        };
        out.note(Code::PC061, message.into(), &help);
    }
    if spec.ratio.is_some() && (spec.norevr || spec.rapout) {
        let message = "`ratio` has no effect, because this tap does not feed out";
        out.note(Code::PC057, message.into(), "remove `ratio`");
    }
    if shape.options.sink_as_printed && spec.kind == CycleKind::Csink && spec.angle.is_some_and(|angle| angle > 90.0) {
        let message = "the formula of `--csink-depth printed` makes this countersink too deep";
        out.note(Code::PC059, message.into(), "render without `--csink-depth printed`");
    }
    if spec.min_step.is_some() && spec.decr.is_none() && shape.program.settings.cycle_min_step == 0.0 {
        let message = "`min_step` has no effect, because the steps do not shrink";
        out.note(Code::PC055, message.into(), "remove `min_step`, or give `decr`");
    }
    let floats = spec.kind.is_tap() && spec.rigid == Some(false) && !spec.norevr && !spec.rapout;
    let asks = |id| shape.program.routine(id).is_some_and(|routine| routine.asks(VarId::Rigid, shape.program));
    if floats && shape.program.settings.rigid_tap && sequence.is_some_and(|id| !asks(id)) {
        let help = "if this tap must not be rigid, print other words for rigid taps, in `@if [rigid]`";
        out.note(Code::PR021, "a floating tap, but the form's tap is rigid".into(), help);
    }
    if let (Some(mode), true) = (spec.mode, sequence.is_some()) {
        let message = format!("the kind of pecks of the tap, here `{}`, is a setting of the control", mode.name());
        out.note(Code::PR021, message, "set the kind of pecks at the control: no word of a form selects it");
    }
}
