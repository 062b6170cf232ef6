//! Operations: tool changes, and the changes at a new operation that keeps the tool.

use super::comments::comment_block;
use super::sections::check_sections_closed;
use super::start::begin_main;
use super::table::Subprograms;
use super::variables::set_named;
use crate::compile::Routine;
use crate::control::Meaning;
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, TextId, VarId, VarSet};
use crate::render::ahead;
use crate::render::cx::{Cx, Writer};
use crate::render::cycle::hole::hole_position;
use crate::render::fault::{Done, fault, fault_at};
use crate::render::more_coolants::end_beside;
use crate::render::moves::rotary::change_turns;
use crate::render::printer::Printer;
use crate::render::prints::{prints_axis_words, says_speed_mode, says_work};
use crate::render::said::{LastMove, Said};
use crate::render::settle::{check_reading_of, speed_mode_before};
use crate::render::shape::Shape;
use crate::render::targets::{set_here, set_targets};
use crate::render::turret::turret_word;
use crate::render::upon::{run_with_upons, upons_of_change};
use crate::render::want::Want;
use crate::render::work::work_before;
use crate::toolpath::{Axes, Coolant, FeedMode, First, Section, Tool, ToolChange};

/// The position variables of a tool change.
const POSITION: VarSet = VarSet::of(&[VarId::H, VarId::V, VarId::D]);

/// Begins an operation.
pub fn tool_change(
    change: &ToolChange,
    shape: &mut Shape,
    want: &mut Want,
    said: &mut Said,
    out: &mut Printer,
    subs: &mut Subprograms,
    sections: &[Section],
) -> Done {
    check_sections_closed(sections)?;
    end_operation(&mut Cx { shape, want, said, out })?;
    begin_main(&mut Cx { shape, want, said, out }, subs)?;
    let new = change.changes_to(want.tool);
    if change.tool.is_none() && want.tool.is_none() && shape.program.settings.machine != Machine::Edm {
        let help = "load a tool before the first motion; for a CL file, give the tool with `--assume-tool`";
        return fault(Code::PJ006, "the operation has no tool", help);
    }
    want.standing_told = false;
    let work = want.get(VarId::Work);
    set_conditions(change, new.is_some(), shape, want, out)?;
    want.texts.operation(change, shape);
    if let Some(tool) = new {
        said.from_home = false;
        change_tool(tool, change, shape, want, said, out)?;
    } else {
        let now = want.get(VarId::Work);
        said.stand.changes_work(work, now);
        if let First::Rapid(first) = &change.first
            && work.is_some()
            && work != now
        {
            said.stand.goes_to_first(first, shape);
        }
        operation_comment(change, None, &mut Cx { shape, want, said, out })?;
        change.tool.as_ref().map_or(Ok(()), |tool| same_registers(tool, want))?;
    }
    want.in_operation = true;
    run_here(SequenceId::Operation, &mut Cx { shape, want, said, out })
}

/// Prints the operation's comment if neither the tool change sequence nor the Operation sequence prints it.
fn operation_comment(change: &ToolChange, routine: Option<&Routine>, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let says = |routine: &Routine| routine.texts.has(TextId::Optext);
    let by_form = routine.is_some_and(says) || shape.routine(SequenceId::Operation, cx.want, cx.said).is_some_and(says);
    match change.comment.as_ref().filter(|_| !by_form) {
        Some(comment) => comment_block(comment, cx),
        None => Ok(()),
    }
}

/// Ends the open operation.
pub fn end_operation(cx: &mut Cx<'_>) -> Done {
    if !std::mem::take(&mut cx.want.in_operation) {
        return Ok(());
    }
    run_here(SequenceId::EndOperation, cx)
}

/// If the form has this sequence, prints it at the current position of the tool.
fn run_here(id: SequenceId, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let Some(routine) = shape.program.routine(id) else { return Ok(()) };
    set_here(shape, cx.want, cx.said)?;
    let routine = shape.way(routine, cx.want, cx.said);
    run_with_upons(routine, cx)?;
    if prints_axis_words(routine, true, shape) {
        cx.said.stand.moved_by = Some(routine.span);
    }
    Ok(())
}

/// The sequence that prints the next tool change.
fn change_of(want: &Want) -> SequenceId {
    if want.tool.is_none() { SequenceId::FirstToolChange } else { SequenceId::ToolChange }
}

/// Checks that the tool in the spindle keeps its offset registers, because no sequence would print new registers.
fn same_registers(tool: &Tool, want: &Want) -> Done {
    let registers = [(VarId::Lcomp, tool.length_offset, "length"), (VarId::Dcomp, tool.diameter_offset, "diameter")];
    for (var, register, name) in registers {
        if register.is_some() && register != want.get(var) {
            let message = format!("the {name} offset register changes while tool {} is in the spindle", tool.number);
            return fault(Code::PR039, message, "use another tool number, or keep the register");
        }
    }
    Ok(())
}

/// Sets spindle, coolant, work offset and feeds of the operation.
fn set_conditions(change: &ToolChange, new_tool: bool, shape: &Shape, want: &mut Want, out: &mut Printer) -> Done {
    if new_tool {
        want.clear_spindle(shape);
    }
    if let Some(spindle) = change.spindle {
        want.set_spindle(&spindle.of_operation(), shape)?;
    }
    match change.coolant {
        Some(coolant) => want.set_coolant(coolant, shape)?,
        None if new_tool => want.coolant_unsaid(shape)?,
        None => {}
    }
    if let Some(work) = change.work {
        want.set_work(work, shape)?;
    }
    if let (Some(tool), Machine::Lathe) = (&change.tool, shape.program.settings.machine) {
        want.set(VarId::Comp, turret_word(tool, shape)?);
    }
    want.properties.operation();
    for (name, value) in &change.set {
        set_named(name, value, shape, want, out)?;
    }
    let mode = change.feed_mode.unwrap_or(FeedMode::PerMinute);
    match mode {
        FeedMode::PerMinute => {}
        FeedMode::PerRev => shape.needs(Meaning::PerRev)?,
        FeedMode::InverseTime => shape.needs(Meaning::InverseTime)?,
    }
    want.set_feed_mode(mode, shape);
    want.keep_feed(None, shape);
    if let Some(feed) = change.feed {
        want.set_feed(feed, shape);
    }
    let plunge = change.plunge.or(change.feed).map(|feed| feed * shape.scale);
    want.put(VarId::Plunge, plunge);
    want.changed = true;
    Ok(())
}

fn change_tool(
    tool: &Tool,
    change: &ToolChange,
    shape: &mut Shape,
    want: &mut Want,
    said: &mut Said,
    out: &mut Printer,
) -> Done {
    let (program, first) = (shape.program, &change.first);
    if want.compensated {
        let help = "end the compensation with an `outfeed` first";
        return fault(Code::PR030, "the tool changes under cutter compensation", help);
    }
    let id = change_of(want);
    end_beside(Coolant::OFF, &mut Writer { shape, want, said, out })?;
    next_tool(tool, shape, want)?;
    want.tool = Some(tool.number);
    said.stand.fresh_tool = Some(said.stand.position.given);
    want.tool_changes += 1;
    let shape = &*shape;
    operation_comment(change, shape.routine(id, want, said), &mut Cx { shape, want, said, out })?;
    let routine = shape.routine(id, want, said);
    let first_target = match first {
        First::Rapid(to) => Some((said.stand.target(to, shape), to.given)),
        First::Hole(spec, hole) => {
            Some((hole_position(spec, hole, shape, want, said)?, hole.at.given | shape.depth_bit()))
        }
        First::Cut | First::Nothing => None,
    };
    let target = match (first_target, routine) {
        (Some((target, given)), Some(routine)) => {
            Some(change_turns(routine, &target, given, &mut Cx { shape, want, said, out })?)
        }
        _ => None,
    };
    // a new tool has no last position that a first rapid could keep
    said.forget_tool();
    want.forget(&[VarId::H, VarId::V, VarId::D]);
    if let Some(target) = &target {
        set_targets(target, shape, want, said)?;
    }
    let Some(routine) = shape.routine(id, want, said) else { return Ok(()) };
    match &target {
        Some(_) => {}
        None if routine.vars.meets(POSITION) => {
            let at = routine.steps().next().map(|first| program.spans[first]);
            let help = "begin the operation with a rapid to a position above its first cut";
            return match first {
                First::Cut => {
                    let message =
                        "the operation begins with a cut: the tool change would make a rapid to the end of this cut";
                    fault_at(Code::PR012, message, help, at)
                }
                _ => {
                    fault_at(Code::PR012, "the tool change prints a position, but the operation has no move", help, at)
                }
            };
        }
        None => {}
    }
    if routine.vars.meets(POSITION) && !says_work(routine, shape) {
        work_before(&mut Writer { shape, want, said, out })?; // the position is relative to this offset
    }
    if routine.vars.has(VarId::Speed) && !says_speed_mode(routine, shape) {
        speed_mode_before(&mut Writer { shape, want, said, out })?; // otherwise a surface speed counts as revolutions
    }
    check_reading_of(routine, shape, want, said)?;
    said.stand.placed = 0;
    said.stand.moved_by = None;
    upons_of_change(routine, shape, want, said);
    run_with_upons(routine, &mut Cx { shape, want, said, out })?;
    said.keep_speed_of_change(want, shape);
    if routine.vars.has(VarId::Coolantoff) {
        want.ends_coolant = None;
    }
    want.ends_what_is_on(shape);
    if let Some(target) = target {
        said.stand.move_to(&Axes { given: target.given & said.stand.placed, ..target });
    }
    said.say_motion_again();
    said.last_move = LastMove::None;
    if program.settings.restart_depth {
        said.forget(&shape.letters[shape.axes[shape.depth]]);
    }
    said.force(shape);
    Ok(())
}

fn next_tool(tool: &Tool, shape: &mut Shape, want: &mut Want) -> Done {
    want.put(VarId::Lasttool, want.tool);
    if want.tool.is_none() {
        want.set(VarId::Tool1, tool.number);
    }
    want.set(VarId::Isfirsttool, f64::from(u8::from(want.tool.is_none())));
    ahead::tool_variables(tool, shape, want);
    shape.choose_turret(tool.turret);
    if let Some(order) = &want.tool_order {
        if order.get(want.tool_changes) != Some(&tool.number) {
            let message = format!("tool {} is the next tool, but `tool_order` lists another", tool.number);
            return fault(Code::PJ012, message, "list the tools in the order of their use");
        }
        let next = order.get(want.tool_changes + 1).or_else(|| order.first()).copied();
        let is_last = want.tool_changes + 1 == order.len();
        want.put(VarId::Nexttool, next);
        want.set(VarId::Islasttool, f64::from(u8::from(is_last)));
    }
    Ok(())
}
