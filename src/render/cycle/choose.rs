//! Selects the sequence that prints a cycle.

use super::open::is_rigid;
use crate::compile::{CycleStyle, Routine};
use crate::control::{self, Meaning};
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::render::fault::{Done, fault};
use crate::render::options::Cycles;
use crate::render::printer::Printer;
use crate::render::prints::{prints_code, prints_letter};
use crate::render::shape::Shape;
use crate::sema::kind_of_remark;
use crate::toolpath::{CycleKind, CycleSpec, Peck};

/// The kinds of cycle whose sequences can print this cycle, best first. As in GENER, some cycles are printed by the
/// sequence of another kind of cycle.
fn made_as(spec: &CycleSpec) -> [Option<CycleKind>; 3] {
    use CycleKind as K;
    let dwells = spec.dwell.or(spec.revs).is_some_and(|time| time > 0.0);
    let faces = dwells.then_some(K::Face);
    match spec.kind {
        K::Drill => [faces, Some(K::Drill), None],
        K::Csink => [Some(K::Csink), faces, Some(K::Drill)],
        K::Tap | K::LTap if spec.norevr => [Some(K::Face), None, None],
        K::Tap | K::LTap if spec.rapout => [faces, Some(K::Drill), None],
        kind => [Some(kind), None, None],
    }
}

/// The sequence that prints a cycle; `None` if the cycle becomes single moves.
pub fn choose_sequence(spec: &CycleSpec, shape: &Shape, out: &mut Printer) -> Done<Option<SequenceId>> {
    let program = shape.program;
    let rigid = is_rigid(spec, shape);
    let emulated = shape.options.cycles == Cycles::Emulated || spec.emulate && !rigid;
    let candidate = candidate(spec, shape).filter(|_| !emulated);
    let floats = |routine: &Routine| !program.settings.rigid_tap && !routine.asks(VarId::Rigid, program);
    if rigid && spec.rigid == Some(true) && candidate.and_then(|id| program.routine(id)).is_some_and(floats) {
        let message = "a rigid tap, but the form's tap is for a floating holder";
        let codes = program.settings.codes();
        let ahead = codes.rows().find(|row| row.meaning == Meaning::RigidAhead).map(|row| row.code);
        let help = match ahead {
            Some(code) => format!(
                "print `{code} S[speed]` on its own line before the cycle in the Tap sequence, and write `RigidTap? Y` in \
                 the form; if the form prints both kinds of taps, print {code} in `@if [rigid]`"
            ),
            None => {
                "write `RigidTap? Y` in the form if its tap is rigid, or test `@if [rigid]` in the Tap sequence".into()
            }
        };
        return fault(Code::PC021, message, help);
    }
    let why = match candidate.and_then(|id| program.routine(id).map(|routine| (id, routine))) {
        Some((id, routine)) => match cannot_say(spec, routine, shape) {
            None => return Ok((routine.style != CycleStyle::Generated).then_some(id)),
            Some(what) => format!("{} does not print {what}", id.name()),
        },
        None if emulated => "cycles are emulated".to_owned(),
        None => format!("the form has no sequence for `{}`", spec.kind.name()),
    };
    if rigid {
        let message = format!("a rigid tap can't be printed as single moves, but {why}");
        return fault(
            Code::PC021,
            message,
            "print it in the form's Tap sequence; remove `ratio`, `decr` and `pecks` from the cycle and set them at \
             the control, because no form prints them",
        );
    }
    if candidate.is_some() {
        out.note(Code::PR014, format!("the cycle is printed as single moves: {why}"), "check the moves");
    }
    Ok(None)
}

/// The form's sequence for a kind of cycle; `None` if the form has no sequence for this kind.
fn candidate(spec: &CycleSpec, shape: &Shape) -> Option<SequenceId> {
    use SequenceId as S;
    let program = shape.program;
    let custom = |kind: CycleKind| {
        let labels = program.custom.iter().zip([S::Custom1, S::Custom2, S::Custom3]);
        let name = kind.name();
        let is_kind = |label: &String| kind_of_remark(label).is_some_and(|kind| kind.eq_ignore_ascii_case(name));
        labels.filter(|(label, _)| label.as_ref().is_some_and(is_kind)).map(|(_, id)| id).next()
    };
    let serves = |kind: CycleKind| match kind.sequence() {
        Some(own) if program.routine(own).is_some() => Some(own),
        None if kind == CycleKind::Face => custom(kind).or_else(|| {
            let prints_dwell = |routine: &&Routine| routine.vars.has(VarId::Dwell);
            program.routine(S::Drill).filter(prints_dwell).map(|_| S::Drill)
        }),
        _ => custom(kind),
    };
    made_as(spec).into_iter().flatten().find_map(serves)
}

/// The first value that the cycle requests and that its sequence does not print.
pub fn cannot_say(spec: &CycleSpec, routine: &Routine, shape: &Shape) -> Option<&'static str> {
    if routine.style == CycleStyle::Generated {
        return None;
    }
    let prints = |vars: &[VarId]| vars.iter().any(|&var| routine.vars.has(var));
    let pecks = matches!(spec.kind, CycleKind::Deep | CycleKind::Chipbreak) || spec.mode.is_some();
    let custom = matches!(spec.kind, CycleKind::Custom1 | CycleKind::Custom2 | CycleKind::Custom3);
    let program = shape.program;
    let own = !custom; // only the form defines what a custom cycle must print
    let across = own && program.settings.machine == Machine::Mill; // a lathe drills at the centre of the part
    let absolute = |code: control::Code| code.is_g(program.settings.inc_abs[1]);
    let positions = &[VarId::H, VarId::V, VarId::D, VarId::Vclear, VarId::Rplane];
    let steps = program.settings.incremental && prints(positions) && !prints_code(routine, absolute, shape);
    let feeds_out = !spec.norevr && !spec.rapout;
    // F of a tap may be the spindle speed
    let feeds = spec.kind.is_tap() && prints_letter(routine, program.settings.feed_code, shape);
    let by_form = shape.defaults.orient;
    let other_angle = spec.orient.is_some_and(|orient| orient.angle(by_form) != by_form);
    let missing = [
        (steps, &[][..], "the increments that the control expects here"),
        (across, &[VarId::H], "the position: [h]"),
        (across, &[VarId::V], "the position: [v]"),
        (own && spec.kind != CycleKind::Manual, &[VarId::D, VarId::Depth], "the depth: [d]"),
        (
            own && !feeds && spec.kind != CycleKind::Manual,
            &[VarId::Frate, VarId::Plunge, VarId::Pitch],
            "the feed: [frate]",
        ),
        (!spec.pecks.is_empty(), &[], "absolute pecks (`pecks`)"),
        (spec.times.is_some(), &[], "full retracts between chip breaks (`times`)"),
        (spec.decr.is_some(), &[], "shrinking pecks (`decr`)"),
        (!spec.webs.is_empty(), &[], "webs"),
        (spec.rapto.is_some(), &[], "the extra rapid (`rapto`)"),
        (feeds_out && spec.ratio.is_some_and(|r| r != 1.0), &[], "the retract feed (`ratio`)"),
        (spec.starts.is_some_and(|s| s > 1.0), &[VarId::Vclear], "several starts: [vclear]"),
        (spec.hole_diameter.is_some(), &[], "the rapid to the cone (`hole_diameter`)"),
        (other_angle, &[], "the spindle angle (`orient`)"),
        // a control orients the spindle in a boring cycle only if the cycle also jogs the tool off the wall
        (spec.kind == CycleKind::Bore && spec.orient.is_some(), &[VarId::Sleave], "an oriented spindle: [sleave]"),
        (spec.jog.is_some(), &[], "the lift of the jog (`jog`)"),
        (spec.offset_y.is_some(), &[], "a jog along both axes (`offset_y`)"),
        (spec.offset.is_some(), &[VarId::Sleave], "the jog off the wall: [sleave]"),
        (spec.dwell.or(spec.revs).is_some_and(|t| t > 0.0), &[VarId::Dwell], "the dwell: [dwell]"),
        (spec.first_step.is_some(), &[VarId::Peck1, VarId::Inidep], "the first peck: [peck1]"),
        (spec.min_step.is_some(), &[VarId::Sbite], "the least peck: [sbite]"),
        (pecks && spec.step.is_some(), &[VarId::Vbite], "the peck: [vbite]"),
    ];
    missing.into_iter().find(|(asked, vars, _)| *asked && !prints(vars)).map(|(_, _, what)| what)
}

/// Converts a cycle of the job to program units.
pub fn scaled(spec: &CycleSpec, shape: &Shape) -> CycleSpec {
    let scale = shape.scale;
    let length = |value: Option<f64>| value.map(|v| v * scale);
    CycleSpec {
        depth: length(spec.depth),
        clear: length(spec.clear),
        return_height: length(spec.return_height),
        feed: length(spec.feed),
        plunge: length(spec.plunge),
        step: length(spec.step),
        first_step: length(spec.first_step),
        back: length(spec.back),
        rapto: length(spec.rapto),
        offset: length(spec.offset),
        offset_y: length(spec.offset_y),
        decr: length(spec.decr),
        min_step: length(spec.min_step),
        diameter: length(spec.diameter),
        hole_diameter: length(spec.hole_diameter),
        webs: spec.webs.iter().map(|w| w * scale).collect(),
        pecks: spec.pecks.iter().map(|p| Peck { to: p.to * scale, feed: p.feed.map(|f| f * scale) }).collect(),
        jog: length(spec.jog),
        ..spec.clone()
    }
}
