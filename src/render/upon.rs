//! Upon sequences: printed when a variable changes, before what uses it.

use super::fault::{Done, fault_at};
use super::motion::{MOVED, NOW};
use super::renderer::Renderer;
use crate::compile::{LetterKind, Op, Routine, Upon};
use crate::diag::Code;
use crate::lang::{SequenceId, VarId, VarSet};

impl Renderer<'_> {
    /// Is an Upon sequence due before these variables are used? `moving`: one that prints words of axes.
    pub(super) fn upon_is_due(&self, used: VarSet, moving: bool) -> bool {
        self.shape.program.upon_vars.meets(used)
            && self.shape.program.upons.iter().zip(&self.upon_used).any(|(upon, before)| {
                let Some(value) = self.vars.get(upon.var).filter(|_| used.has(upon.var)) else { return false };
                is_due(upon, *before, value) && (!moving || self.names_axes(&upon.routine, false))
            })
    }

    /// Another work offset together with another view: Index takes the tool away and goes over the new place, so the
    /// offset's code is all that is left of an Upon sequence that does the same.
    pub(super) fn index_serves_work(&self) -> bool {
        let retracts =
            self.shape.program.routine(SequenceId::Index).is_some_and(|routine| self.names_axes(routine, true));
        let only_moves = |upon: &Upon| {
            upon.routine.ops.clone().all(|i| match self.shape.program.ops[i] {
                Op::Line { .. } => true,
                Op::Var { letter, var, .. } => {
                    var == VarId::Work || self.shape.letters[letter].kind == LetterKind::Axis
                }
                Op::Literal { index, .. } => {
                    let kind = self.shape.letters[self.shape.program.literals[index as usize].letter].kind;
                    matches!(kind, LetterKind::Axis | LetterKind::GCode)
                }
                Op::Remark { .. } => true,
                Op::Value { .. } | Op::Text { .. } => false,
            })
        };
        retracts && self.shape.program.upons.iter().filter(|upon| upon.var == VarId::Work).all(only_moves)
    }

    /// A tool change prints what it uses: an Upon that moves would do so with the tool that goes.
    pub(super) fn upons_of_change(&mut self, routine: &Routine) {
        for (i, upon) in self.shape.program.upons.iter().enumerate() {
            if routine.vars.has(upon.var) && self.names_axes(&upon.routine, false) {
                self.upon_used[i] = self.vars.get(upon.var).or(self.upon_used[i]);
            }
        }
    }

    /// A variable's value was printed otherwise: no Upon is due for it.
    pub(super) fn served_upons(&mut self, var: VarId, value: f64) {
        for (upon, used) in self.shape.program.upons.iter().zip(&mut self.upon_used) {
            if upon.var == var && !upon.every {
                *used = Some(value);
            }
        }
    }

    /// Runs a sequence after the Upon sequences of the variables that it prints.
    pub(super) fn run_with_upons(&mut self, routine: &Routine) -> Done {
        self.upons(routine.vars)?;
        self.run_block(routine)
    }

    /// Before these variables are used: prints the Upon sequences that are due. Their bodies trigger none.
    pub(super) fn upons(&mut self, used: VarSet) -> Done {
        let program = self.shape.program;
        if !program.upon_vars.meets(used) {
            return Ok(());
        }
        for (i, upon) in program.upons.iter().enumerate() {
            if !used.has(upon.var) {
                continue;
            }
            let Some(value) = self.vars.get(upon.var) else { continue };
            let before = self.upon_used[i].replace(value);
            if is_due(upon, before, value) {
                let moves = self.names_axes(&upon.routine, false);
                if moves && self.compensated {
                    let message = format!("Upon [{}] moves the tool under cutter compensation", upon.var.name());
                    let help = "end the compensation with an `outfeed` before the change";
                    return fault_at(Code::PR006, message, help, Some(upon.routine.span));
                }
                let placed = std::mem::take(&mut self.placed);
                self.way_before(&upon.routine)?;
                self.run_block(&upon.routine)?;
                self.stands_where_it_was_put();
                self.placed |= placed;
                if self.names_axes(&upon.routine, true) {
                    self.moved_by = Some(upon.routine.span);
                }
            }
        }
        Ok(())
    }
}

impl Renderer<'_> {
    /// Increments count from the position that the sequence printed: nothing is left to go along its axes.
    fn stands_where_it_was_put(&mut self) {
        if !self.shape.program.settings.incremental {
            return;
        }
        for (axis, (now, moved)) in NOW.into_iter().zip(MOVED).enumerate() {
            if self.placed & 1 << axis != 0
                && let Some(value) = self.vars.get(now)
            {
                self.position.set(axis, value / self.shape.scales[axis]);
                self.vars.set(moved, 0.0);
            }
        }
    }
}

/// The first use only sets the baseline, unless it prints at every use.
fn is_due(upon: &Upon, before: Option<f64>, value: f64) -> bool {
    upon.every || before.is_some_and(|before| before != value)
}
