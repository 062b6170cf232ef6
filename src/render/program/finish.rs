//! The end of a program.

use super::calls::check_calls;
use super::sections::check_sections_closed;
use super::start::begin_main;
use super::subprograms::{append_waiting, has_waiting};
use super::table::Subprograms;
use super::tools::end_operation;
use crate::compile::{Op, Routine};
use crate::diag::Code;
use crate::lang::{Coolant, SequenceId};
use crate::render::body::{Mode, go_on, run_part};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::more_coolants::end_beside;
use crate::render::settle::check_reading_of;
use crate::render::shape::Shape;
use crate::render::targets::set_here;
use crate::render::unnumbered::is_closing;
use crate::render::upon::{run_with_upons, upons};
use crate::toolpath::Section;

/// Prints the end of the job: the EndCode sequence.
pub fn finish(cx: &mut Cx<'_>, subs: &mut Subprograms, sections: &[Section]) -> Done {
    let shape = cx.shape;
    check_sections_closed(sections)?;
    if cx.want.compensated {
        let message = "cutter compensation is still on at the end of the program";
        cx.out.note(Code::PR023, message.into(), "end the compensation with an `outfeed`");
    }
    if let Some(order) = &cx.want.tool_order
        && cx.want.tool_changes != order.len()
    {
        let message = format!("`tool_order` lists {} tools, but the job used {}", order.len(), cx.want.tool_changes);
        return fault(Code::PJ012, message, "list the tools in the order of their use, each change once");
    }
    end_operation(cx)?;
    begin_main(cx, subs)?;
    check_calls(subs)?;
    set_here(shape, cx.want, cx.said)?;
    end_beside(Coolant::OFF, &mut cx.writer())?;
    cx.want.ends_what_is_on(shape);
    let Some(routine) = shape.routine(SequenceId::EndCode, cx.want, cx.said) else { return Ok(()) };
    check_reading_of(routine, shape, cx.want, cx.said)?;
    if !has_waiting(subs) {
        return run_with_upons(routine, cx);
    }
    // subprograms come after the main program, before the `%` or `END PGM` that ends the text
    let percent = closing_line(routine, shape);
    upons(routine.vars, cx)?;
    run_part(routine, routine.ops.start..percent, Mode::All, &mut cx.writer())?;
    append_waiting(cx.out, subs);
    go_on(routine, percent..routine.ops.end, Mode::All, &mut cx.writer())
}

/// The last line of the EndCode sequence, if this line ends the program text; otherwise the end of EndCode.
fn closing_line(routine: &Routine, shape: &Shape) -> usize {
    let mut lines = routine.steps().rev().filter(|&i| matches!(shape.program.ops[i], Op::Line { .. }));
    lines.next().filter(|&line| is_closing(line, shape)).unwrap_or(routine.ops.end)
}
