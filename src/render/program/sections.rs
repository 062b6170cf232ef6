//! Named parts of a path, and actions of a wire EDM machine between moves.

use crate::diag::Code;
use crate::lang::{Machine, SequenceId};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::prelude::way_before;
use crate::render::prints::prints_axis_words;
use crate::render::said::LastMove;
use crate::render::shape::Shape;
use crate::render::targets::set_here;
use crate::render::upon::run_with_upons;
use crate::toolpath::{EdmAction, Section};

/// The sequences that print the begin and the end of a part of the path.
fn sequences(section: Section) -> (SequenceId, SequenceId) {
    use SequenceId as S;
    match section {
        Section::Leadin => (S::BeginLeadin, S::EndLeadin),
        Section::Leadout => (S::BeginLeadout, S::EndLeadout),
        Section::Plunge => (S::BeginPlunge, S::EndPlunge),
        Section::Retract => (S::BeginRetract, S::EndRetract),
        Section::SideStep => (S::BeginSideStep, S::EndSideStep),
        Section::ZLevel => (S::BeginZLevel, S::EndZLevel),
        Section::Row => (S::BeginRow, S::EndRow),
        Section::Cut => (S::BeginCut, S::EndCut),
    }
}

fn part(section: Section) -> &'static str {
    match section {
        Section::Leadin => "lead-in",
        Section::Leadout => "lead-out",
        Section::Plunge => "plunge",
        Section::Retract => "retract",
        Section::SideStep => "side step",
        Section::ZLevel => "Z level",
        Section::Row => "row",
        Section::Cut => "cut",
    }
}

/// Begins a part.
pub fn begin_section(section: Section, cx: &mut Cx<'_>, sections: &mut Vec<Section>) -> Done {
    let shape = cx.shape;
    let (begin, _) = sequences(section);
    check_section(begin, shape)?;
    sections.push(section);
    run_section(begin, cx)
}

/// Ends the part of the path that began last.
pub fn end_section(section: Section, cx: &mut Cx<'_>, sections: &mut Vec<Section>) -> Done {
    let shape = cx.shape;
    let (begin, end) = sequences(section);
    check_section(begin, shape)?;
    match sections.pop() {
        Some(open) if open == section => run_section(end, cx),
        Some(open) => fault(
            Code::PJ011,
            format!("a {} ends inside a {}", part(section), part(open)),
            "first end the part that began last",
        ),
        None => fault(
            Code::PJ011,
            format!("the end of a {} that did not begin", part(section)),
            "begin the part first, or remove the end",
        ),
    }
}

fn run_section(id: SequenceId, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    match shape.program.routine(id) {
        Some(routine) => {
            set_here(shape, cx.want, cx.said)?;
            let routine = shape.way(routine, cx.want, cx.said);
            // an arc code would need a centre; a feed code keeps the sequence a cut
            if matches!(cx.said.last_move, LastMove::Cw | LastMove::Ccw) {
                cx.want.cutting = true;
                way_before(routine, &mut cx.writer())?;
            }
            run_with_upons(routine, cx)?;
            if prints_axis_words(routine, true, shape) {
                cx.said.stand.moved_by = Some(routine.span);
            }
            Ok(())
        }
        None => Ok(()),
    }
}

fn check_section(id: SequenceId, shape: &Shape) -> Done {
    let machine = shape.program.settings.machine;
    if id.row().machines.has(machine) {
        return Ok(());
    }
    let message = format!("the path of a form for {} can't contain this part", machine.name());
    fault(Code::PR008, message, format!("{} is for {}", id.name(), id.row().machines))
}

/// Checks that all parts of the path are closed at the end of an operation.
pub fn check_sections_closed(sections: &[Section]) -> Done {
    match sections.last() {
        None => Ok(()),
        Some(&open) => {
            fault(Code::PJ011, format!("a {} is still open here", part(open)), "end the part before the operation ends")
        }
    }
}

/// Prints an action of a wire EDM machine between moves. The form must have a sequence for this action.
pub fn edm(action: EdmAction, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let machine = shape.program.settings.machine;
    if machine != Machine::Edm {
        let message = format!("a {} has no wire", machine.name());
        return fault(Code::PR008, message, "remove the item, or render it for a wire EDM machine");
    }
    let (id, what) = match action {
        EdmAction::Thread => (SequenceId::EdmThread, "threads the wire"),
        EdmAction::Cut => (SequenceId::EdmCut, "cuts the wire"),
        EdmAction::PreDrill => (SequenceId::EdmPreDrillThread, "drills a start hole"),
        EdmAction::Submerge => (SequenceId::SubmergeTank, "fills the tank"),
    };
    if shape.program.routine(id).is_none() {
        let message = format!("the job {what} here, but the form has no {}", id.name());
        let help = format!("add the sequence `{}` with the words of the machine, and `End`", id.name());
        return fault(Code::PR008, message, help);
    }
    run_section(id, cx)
}
