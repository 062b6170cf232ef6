//! The beginning of a program.

use super::table::Subprograms;
use super::variables::{set_named, set_variable};
use crate::compile::{Op, Routine};
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::render::ahead;
use crate::render::body::{Mode, run_part};
use crate::render::cx::{Cx, Writer};
use crate::render::fault::{Done, fault};
use crate::render::printer::Printer;
use crate::render::said::Said;
use crate::render::shape::Shape;
use crate::render::unnumbered::is_percent;
use crate::render::upon::{run_with_upons, upons};
use crate::render::vars::PLACE;
use crate::render::want::Want;
use crate::toolpath::{Start, Units};

/// Prints the beginning of the job: units, checks, the Mod text and the StartCode sequence.
pub fn start(
    start: &Start,
    shape: &mut Shape,
    want: &mut Want,
    said: &mut Said,
    out: &mut Printer,
    subs: &mut Subprograms,
) -> Done {
    let program = shape.program;
    let settings = &program.settings;
    if start.machine != settings.machine {
        let message =
            format!("the job is for a {}, but the form is for a {}", start.machine.name(), settings.machine.name());
        return fault(Code::PR008, message, "use a form for this machine");
    }
    shape.choose_units(start.units)?;
    want.set(VarId::Unitmode, settings.inch_mm[usize::from(shape.units == Units::Mm)]);
    out.set_letters(settings, shape.letters);
    want.tool_order = start.tool_order.as_deref().map(Into::into);
    ahead::of_program(shape, want);
    if let Some(first) = want.tool_order.as_ref().and_then(|order| order.first().copied()) {
        want.set(VarId::Tool1, first);
    }
    want.put(VarId::Program, shape.options.program.map(f64::from).or(start.program));
    answers(start, shape, want, out)?;
    want.texts.start(start, shape);
    for text in &settings.mod_text {
        out.text(text, false);
        out.end_block();
    }
    if settings.is_flat {
        let axis = char::from(settings.axes[2]);
        let message = format!("{axis} is ignored: positions and cuts along it are neither printed nor compared");
        out.note(
            Code::PR059,
            message,
            "check the heights in the form; without `Ignore` the heights of the job are printed",
        );
    }
    let shape = &*shape;
    if let Some(routine) = shape.routine(SequenceId::StartCode, want, said) {
        upons(routine.vars, &mut Cx { shape, want, said, out })?;
        // if subprograms come first, print only the leading `%` now
        let now = if settings.subs_first { start_code_rest(routine, shape) } else { routine.ops.end };
        run_part(routine, routine.ops.start..now, Mode::All, &mut Writer { shape, want, said, out })?;
        subs.start_waits = settings.subs_first;
    }
    Ok(())
}

/// Stores values from the job and the caller. Every prompt of the form needs a value.
pub fn answers(start: &Start, shape: &Shape, want: &mut Want, out: &mut Printer) -> Done {
    for (name, value) in &start.set {
        set_named(name, value, shape, want, out)?;
    }
    want.properties.keep();
    for (var, value) in shape.options.set.clone() {
        set_variable(var, value, want, out);
    }
    for prompt in &shape.program.settings.prompts {
        if want.get(prompt.var).is_some() {
            continue;
        }
        let Some(default) = prompt.default else {
            let name = prompt.var.name();
            let diag = crate::diag::Diag::new(Code::PR015, format!("[{name}] needs an answer: {}", prompt.text))
                .at(prompt.span, "the prompt is here")
                .help(format!("answer with `--set {name}=VALUE`"));
            return Err(Box::new(diag));
        };
        want.set(prompt.var, default);
    }
    want.most_rpm = want.get(VarId::Maxrpm);
    Ok(())
}

/// If subprograms precede the main program, only the leading `%` line of the StartCode sequence is printed before the
/// subprograms. Returns the first operation of the rest of StartCode.
fn start_code_rest(routine: &Routine, shape: &Shape) -> usize {
    let ops = &shape.program.ops;
    let mut lines = routine.steps().filter(|&i| matches!(ops[i], Op::Line { .. }));
    match lines.next() {
        Some(first) if is_percent(first, shape) => lines.next().unwrap_or(routine.ops.end),
        _ => routine.ops.start,
    }
}

/// Begins the main program: prints the Between sequence and the rest of the StartCode sequence.
pub fn begin_main(cx: &mut Cx<'_>, subs: &mut Subprograms) -> Done {
    let shape = cx.shape;
    if !std::mem::take(&mut subs.start_waits) {
        return Ok(());
    }
    if !subs.defined.is_empty()
        && let Some(routine) = shape.routine(SequenceId::Between, cx.want, cx.said)
    {
        run_with_upons(routine, cx)?;
    }
    if let Some(routine) = shape.routine(SequenceId::StartCode, cx.want, cx.said) {
        cx.said.forget_words();
        let rest = start_code_rest(routine, shape);
        run_part(routine, rest..routine.ops.end, Mode::All, &mut cx.writer())?;
    }
    cx.said.forget_place();
    cx.want.forget(&PLACE);
    Ok(())
}
