//! Prints a hole by a sequence of the form.

use super::open::{Drilling, Setup, cancel, leave_cycle, left_hole};
use super::planned::{Heights, Planned, SAME, hole_variables};
use crate::compile::{CycleStyle, LetterKind, Literal, Op, Routine};
use crate::control;
use crate::diag::Code;
use crate::lang::{VarId, VarSet};
use crate::render::body::{Mode, go_on, run, run_part, run_sets};
use crate::render::cx::{Cx, Writer};
use crate::render::fault::Done;
use crate::render::moves::rapid_blocks::{changes_depth_and_plane, is_below, raise, split_rapid};
use crate::render::numbers::quantised;
use crate::render::prelude::{motion_block, plane_block};
use crate::render::printer::Printer;
use crate::render::prints::{prints_axis_words, prints_code, prints_own_motion};
use crate::render::said::Said;
use crate::render::settle::{check_reading, settle};
use crate::render::shape::Shape;
use crate::render::targets::set_targets;
use crate::render::upon::{upon_is_due, upons};
use crate::render::want::Want;
use crate::toolpath::Axes;

/// Prints a hole by a sequence of the form.
pub fn sequence_hole(routine: &Routine, hole: &Planned, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    set_targets(&hole.target, shape, cx.want, cx.said)?;
    settle_before_hole(routine, cx, drill)?; // `[d]` is the return plane here: no Upon may go down the hole
    hole_variables(hole, shape, cx.want, drill);
    cx.want.set(VarId::D, hole.heights.return_plane);
    let used = routine.vars.without(VarSet::of(&[VarId::D]));
    if upon_is_due(used, false, shape, cx.want, cx.said) {
        leave_cycle(cx, drill)?; // otherwise the control reads these words as a hole
        settle_between_holes(hole, cx, drill)?;
    }
    upons(used, cx)?;
    upon_bottom(routine, hole, cx, drill)?;
    plane_block(control::Code::g(17), routine, &mut cx.writer())?; // otherwise the control drills along another axis
    cx.want.set(VarId::D, hole.heights.bottom);
    if matches!(routine.style, CycleStyle::Emulated) {
        return emulated_hole(routine, hole, cx, drill);
    }
    let starts = starts_cycle(routine, hole.heights, shape, cx.want, cx.said, drill);
    if starts {
        cancel(cx, drill)?;
        settle_between_holes(hole, cx, drill)?; // restores what Cancel switched
        approach(&hole.target, cx)?;
        cx.want.set(VarId::D, hole.heights.bottom);
        warn_of_return(routine, hole.heights, cx.out);
        if let Some(cycle) = &mut drill.open {
            cycle.setup = Setup::new(cx.want, cx.said);
            cycle.branches = routine.branches;
            cycle.initial_level = hole.target.get(shape.depth).unwrap_or(hole.heights.return_plane);
            cycle.in_force = true;
        }
    }
    match routine.style {
        CycleStyle::Advanced => {
            cx.said.forget_letters();
            if starts {
                run_part(routine, routine.ops.start..routine.repeat, Mode::All, &mut cx.writer())?;
                if !drills_at_once(routine, shape) {
                    cx.said.forget_letters(); // the first hole needs all words of its lines
                }
            }
            let rest = routine.repeat..routine.ops.end;
            match starts {
                true => go_on(routine, rest, Mode::Hole, &mut cx.writer())?,
                false => {
                    run_sets(routine, &mut cx.writer())?;
                    run_part(routine, rest, Mode::Hole, &mut cx.writer())?;
                }
            }
        }
        CycleStyle::Machine if !starts => {
            let position = !changes_position(routine, shape, cx.want, cx.said)?;
            run(routine, Mode::NextHole { position }, &mut cx.writer())?;
        }
        _ => run(routine, Mode::All, &mut cx.writer())?,
    }
    let exit = exit_of_cycle(routine, hole.heights, shape, drill);
    left_hole(&hole.target, Some(exit), shape, cx.said, drill)
}

/// Prints a hole by an emulated cycle: a sequence that prints the moves itself, or that starts and ends the control's
/// cycle itself.
fn emulated_hole(routine: &Routine, hole: &Planned, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    raise_to(&hole.target, cx, drill)?;
    if !drill.open.as_ref().is_some_and(|cycle| cycle.in_force) {
        settle_between_holes(hole, cx, drill)?; // restores what Cancel switched
    }
    cx.want.set(VarId::D, hole.heights.bottom);
    cx.said.forget_letters();
    way_to_hole(routine, &mut cx.writer())?;
    run(routine, Mode::Hole, &mut cx.writer())?;
    if let Some(cycle) = &mut drill.open {
        cycle.in_force = routine.stays;
    }
    // after a cycle of the control, the last printed height is the bottom of the hole
    let cycled = prints_code(routine, |code| shape.is_cycle(code), shape);
    let exit = match stays_at_clearance(routine, hole.heights, shape) {
        true => (hole.heights.clear, true),
        false => (hole.heights.return_plane, false),
    };
    left_hole(&hole.target, cycled.then_some(exit), shape, cx.said, drill)
}

/// The height to which a cycle of the control returns, and whether this height is certain. `planned.rs` selects G98 or
/// G99.
fn exit_of_cycle(routine: &Routine, heights: Heights, shape: &Shape, drill: &Drilling) -> (f64, bool) {
    let initial = drill.open.as_ref().map_or(heights.return_plane, |cycle| cycle.initial_level);
    // with `[retplane]` the code decides: G98 if the return plane is above the clearance, else G99
    let higher = heights.return_plane > heights.clear + SAME;
    let returns = routine.returns && (higher || !routine.vars.has(VarId::Retplane));
    let exit = if returns { initial.max(heights.clear) } else { heights.clear };
    // without G98 or G99, the control's own setting decides
    let stays = prints_code(routine, |code| code.is_g(shape.program.settings.return_plane[0]), shape);
    let known = routine.returns || stays || !higher && initial <= heights.clear + SAME;
    (exit, known)
}

/// Whether the tool is certainly at the clearance after an emulated sequence. The tool is at the clearance if G99 is
/// active and no axis word follows the control's cycle.
fn stays_at_clearance(routine: &Routine, heights: Heights, shape: &Shape) -> bool {
    let number = shape.program.settings.return_plane[0];
    let chosen = routine.vars.has(VarId::Retplane) && heights.return_plane <= heights.clear + SAME;
    if !chosen && !prints_code(routine, |code| code.is_g(number), shape) {
        return false;
    }
    let is_line = |i: &usize| matches!(shape.program.ops[*i], Op::Line { .. });
    let cycle = routine.steps().rfind(|&i| match shape.program.ops[i] {
        Op::Literal { index, .. } => {
            shape.program.literals[index as usize].code.is_some_and(|code| shape.is_cycle(code))
        }
        _ => false,
    });
    let Some(end) = cycle.and_then(|cycle| routine.steps_in(cycle..routine.ops.end).find(is_line)) else { return true };
    !prints_axis_words(&Routine { ops: end..routine.ops.end, ..routine.clone() }, false, shape)
}

/// Runs the Upon sequence for the hole's bottom. An Upon sequence that would move the tool to the bottom is not run.
fn upon_bottom(routine: &Routine, hole: &Planned, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    const BOTTOM: VarSet = VarSet::of(&[VarId::D]);
    cx.want.set(VarId::D, hole.heights.bottom);
    if !routine.vars.has(VarId::D)
        || !upon_is_due(BOTTOM, false, shape, cx.want, cx.said)
        || upon_is_due(BOTTOM, true, shape, cx.want, cx.said)
    {
        return Ok(());
    }
    leave_cycle(cx, drill)?; // otherwise the control reads these words as a hole
    settle_between_holes(hole, cx, drill)?;
    cx.want.set(VarId::D, hole.heights.bottom);
    upons(BOTTOM, cx)
}

/// Prints a rapid code for the approach move of an emulated cycle, if the cycle's first block with axis words has no
/// motion code.
fn way_to_hole(routine: &Routine, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let program = shape.program;
    let is_line = |i: &usize| matches!(program.ops[*i], Op::Line { .. });
    let moves = |i: usize| {
        let letter = match program.ops[i] {
            Op::Var { letter, .. } | Op::Formula { letter, .. } => letter,
            Op::Literal { index, .. } => program.literals[index as usize].letter,
            _ => return false,
        };
        shape.letters[letter].kind == LetterKind::Axis
    };
    let Some(first) = routine.steps().find(|&i| moves(i)) else { return Ok(()) };
    let end = routine.steps_in(first..routine.ops.end).find(is_line).unwrap_or(routine.ops.end);
    let begin = Routine { ops: routine.ops.start..end, ..routine.clone() };
    if !prints_own_motion(&begin, shape) {
        motion_block(&program.settings.rapid, &begin, writer)?;
    }
    Ok(())
}

/// Whether the first lines of a cycle with `[count]` drill a hole themselves. Lines with K0 or L0 drill no hole.
fn drills_at_once(routine: &Routine, shape: &Shape) -> bool {
    let typed = |asked: &dyn Fn(&Literal) -> bool| {
        routine.steps_in(routine.ops.start..routine.repeat).any(|i| match shape.program.ops[i] {
            Op::Literal { index, .. } => asked(&shape.program.literals[index as usize]),
            _ => false,
        })
    };
    typed(&|word| word.code.is_some_and(|code| shape.is_cycle(code)))
        && !typed(&|word| matches!(word.letter, b'K' | b'L') && word.value == 0.0)
}

/// Prints waiting changes before a hole. While the control is in its cycle, the changes wait for Cancel, because a
/// block between the holes would be read as a hole. In a cycle, only codes of the sequence itself, such as `G95` for a
/// tap, change the state from the job's request.
fn settle_before_hole(routine: &Routine, cx: &mut Cx<'_>, drill: &Drilling) -> Done {
    let shape = cx.shape;
    if !cx.said.is_unsettled(cx.want) {
        return Ok(());
    }
    let in_force = drill.open.as_ref().is_some_and(|cycle| cycle.in_force);
    match in_force && (routine.cancel || prints_code(routine, |code| shape.is_cycle(code), shape)) {
        // in a form with incremental moves, positions are correct if the sequence prints G90
        true if shape.program.settings.incremental => Ok(()),
        true => check_reading(shape, cx.want, cx.said),
        false => settle(cx),
    }
}

/// Prints waiting changes after the control left its cycle, then sets the variables of the hole again.
fn settle_between_holes(hole: &Planned, cx: &mut Cx<'_>, drill: &Drilling) -> Done {
    let shape = cx.shape;
    set_targets(&hole.target, shape, cx.want, cx.said)?;
    if cx.said.is_unsettled(cx.want) {
        settle(cx)?;
    }
    hole_variables(hole, shape, cx.want, drill);
    cx.want.set(VarId::D, hole.heights.return_plane);
    Ok(())
}

/// Whether the whole cycle must be printed at this hole.
fn starts_cycle(
    routine: &Routine,
    heights: Heights,
    shape: &Shape,
    want: &Want,
    said: &Said,
    drill: &Drilling,
) -> bool {
    let Some(cycle) = &drill.open else { return true };
    if !cycle.in_force || cycle.branches != routine.branches {
        return true;
    }
    // the control would make a rapid to this hole through the material
    let level = cycle.last.and_then(|last| last.get(shape.depth));
    if level.is_none_or(|level| heights.clear > level + SAME) {
        return true;
    }
    // words that are printed only at the first hole would keep their old values
    let first = routine.first_only;
    !first.is_empty() && routine.style != CycleStyle::WholeLine && cycle.setup.differs(first, want, said)
}

/// Whether a position word changes at this hole. If a block has no position word, most controls do not drill a hole.
fn changes_position(routine: &Routine, shape: &Shape, want: &Want, said: &Said) -> Done<bool> {
    for i in routine.steps() {
        let crate::compile::Op::Var { letter, var, .. } = shape.program.ops[i] else { continue };
        let (info, Some(value)) = (&shape.letters[letter], want.get(var)) else { continue };
        if info.kind != LetterKind::Axis {
            continue;
        }
        let units = quantised(info, value)?;
        if !said.holds(info, units) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Moves to the return plane before a cycle of the control: up first or down last.
fn approach(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    if !cx.said.differs_from(target, shape.depth_bit(), shape) {
        return Ok(());
    }
    // the cycle itself moves across
    if changes_depth_and_plane(target, shape, cx.said) && is_below(target, shape, cx.said)? {
        return raise(target, cx);
    }
    split_rapid(target, cx)
}

/// Raises the tool before an emulated cycle if it is below the return plane, because the cycle's first line may move across.
fn raise_to(target: &Axes, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    let goes_up = cx.said.differs_from(target, shape.depth_bit(), shape);
    let across = cx.said.stand.is_of_other_work()
        || (0..2).any(|axis| axis != shape.depth && cx.said.stand.position.get(axis) != target.get(axis));
    if !goes_up || !across || !is_below(target, shape, cx.said)? {
        return Ok(());
    }
    cancel(cx, drill)?; // otherwise the control would read the rapid as a hole
    raise(target, cx)
}

fn warn_of_return(routine: &Routine, heights: Heights, out: &mut Printer) {
    if heights.return_plane > heights.clear + SAME && !routine.returns {
        let message =
            format!("the job requires a return to {}, but the cycle stays at {}", heights.return_plane, heights.clear);
        out.note(Code::PR013, message, "print `G[retplane]` in the cycle, to set the return level");
    }
}
