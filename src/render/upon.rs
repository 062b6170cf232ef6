//! Upon sequences. An Upon sequence is printed when a variable changes, before the block that uses the variable.

use super::body::run_all;
use super::cx::Cx;
use super::fault::{Done, fault_at};
use super::prelude::way_before;
use super::prints::prints_axis_words;
use super::said::Said;
use super::shape::Shape;
use super::vars::{MOVED, NOW};
use super::want::Want;
use crate::compile::{LetterKind, Op, Routine, Upon};
use crate::diag::Code;
use crate::lang::{SequenceId, VarId, VarSet};

/// Whether an Upon sequence must print now. The first use of its variable only stores the value, unless the Upon prints
/// at every use.
fn is_due(upon: &Upon, before: Option<f64>, value: f64) -> bool {
    upon.every || before.is_some_and(|before| before != value)
}

/// Whether an Upon sequence is due before these variables are used. `moving`: consider only Upon sequences that print
/// axis words.
pub fn upon_is_due(used: VarSet, moving: bool, shape: &Shape, want: &Want, said: &Said) -> bool {
    shape.program.upon_vars.meets(used)
        && shape.program.upons.iter().zip(&said.upon_used).any(|(upon, before)| {
            let Some(value) = want.get(upon.var).filter(|_| used.has(upon.var)) else { return false };
            let routine = shape.way(&upon.routine, want, said);
            is_due(upon, *before, value) && (!moving || prints_axis_words(routine, false, shape))
        })
}

/// Whether Index replaces the `Upon` of the work offset, if the offset changes together with the angle. Index replaces
/// the `Upon` if Index retracts the tool and moves over the new position, and if the Upon has no other effects. If
/// Index replaces the `Upon`, only the code of the offset is printed.
pub fn index_replaces_work_upon(shape: &Shape) -> bool {
    let retracts =
        shape.program.routine(SequenceId::Index).is_some_and(|routine| prints_axis_words(routine, true, shape));
    let only_moves = |upon: &Upon| {
        upon.routine.steps().all(|i| match shape.program.ops[i] {
            Op::Line { .. } => true,
            Op::Var { letter, var, .. } => var == VarId::Work || shape.letters[letter].kind == LetterKind::Axis,
            Op::Literal { index, .. } => {
                let kind = shape.letters[shape.program.literals[index as usize].letter].kind;
                matches!(kind, LetterKind::Axis | LetterKind::GCode)
            }
            Op::Remark { .. } => true,
            Op::Value { .. } | Op::Text { .. } => false,
            Op::Set { .. } | Op::RemarkFormula { .. } => true,
            Op::Quote { .. } | Op::TextVar { .. } | Op::Comment { .. } | Op::List { .. } => false,
            Op::PropertyText { .. } => false,
            Op::Formula { .. } | Op::ValueFormula { .. } => false,
        })
    };
    retracts && shape.program.upons.iter().filter(|upon| upon.var == VarId::Work).all(only_moves)
}

/// Records an Upon as already printed if the Upon moves the tool and the tool change prints its variable. Otherwise the
/// Upon would move the old tool.
pub fn upons_of_change(routine: &Routine, shape: &Shape, want: &Want, said: &mut Said) {
    for (i, upon) in shape.program.upons.iter().enumerate() {
        if routine.vars.has(upon.var) && prints_axis_words(&upon.routine, false, shape) {
            said.upon_used[i] = want.get(upon.var).or(said.upon_used[i]);
        }
    }
}

/// Records that a value was printed by other means, so that no Upon sequence prints for the value.
pub fn upons_are_printed(var: VarId, value: f64, shape: &Shape, said: &mut Said) {
    for (upon, used) in shape.program.upons.iter().zip(&mut said.upon_used) {
        if upon.var == var && !upon.every {
            *used = Some(value);
        }
    }
}

/// Runs a sequence after the Upon sequences of its variables.
pub fn run_with_upons(routine: &Routine, cx: &mut Cx<'_>) -> Done {
    upons(routine.vars, cx)?;
    run_all(routine, &mut cx.writer())
}

/// Prints the Upon sequences that are due before these variables are used. Words inside Upon sequences trigger no
/// further Upons.
pub fn upons(used: VarSet, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    if !program.upon_vars.meets(used) {
        return Ok(());
    }
    for (i, upon) in program.upons.iter().enumerate() {
        if !used.has(upon.var) {
            continue;
        }
        let Some(value) = cx.want.get(upon.var) else { continue };
        let before = cx.said.upon_used[i].replace(value);
        if is_due(upon, before, value) {
            let routine = shape.way(&upon.routine, cx.want, cx.said);
            let moves = prints_axis_words(routine, false, shape);
            if moves && cx.want.compensated {
                let message =
                    format!("the sequence Upon [{}] moves the tool under cutter compensation", upon.var.name());
                let help = "end the compensation with an `outfeed` before the change";
                return fault_at(Code::PR030, message, help, Some(routine.span));
            }
            let placed = std::mem::take(&mut cx.said.stand.placed);
            way_before(routine, &mut cx.writer())?;
            run_all(routine, &mut cx.writer())?;
            stands_where_it_was_put(shape, cx.want, cx.said);
            cx.said.stand.placed |= placed;
            if prints_axis_words(routine, true, shape) {
                cx.said.stand.moved_by = Some(upon.routine.span);
            }
        }
    }
    Ok(())
}

/// Makes increments count from the position that the sequence printed. Along the axes of this position, no distance
/// remains.
fn stands_where_it_was_put(shape: &Shape, want: &mut Want, said: &mut Said) {
    for (axis, (now, moved)) in NOW.into_iter().zip(MOVED).enumerate() {
        if said.stand.placed & 1 << axis != 0
            && let Some(value) = want.get(now)
        {
            said.stand.position.set(axis, value / shape.scales[axis]);
            said.stand.aims(1 << axis);
            want.set(moved, 0.0);
        }
    }
}
