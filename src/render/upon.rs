//! Upon sequences: printed when a variable changes, before what uses it.

use super::fault::Done;
use super::renderer::Renderer;
use crate::compile::{Block, LetterKind, Op};
use crate::lang::VarSet;

impl Renderer<'_> {
    /// Does a sequence print words of axes?
    fn names_axes(&self, block: &Block) -> bool {
        block.ops.clone().any(|i| {
            let letter = match self.program.ops[i] {
                Op::Var { letter, .. } => letter,
                Op::Literal { index, .. } => self.program.literals[index as usize].letter,
                _ => return false,
            };
            self.letters[letter].kind == LetterKind::Axis
        })
    }

    /// A variable's value was printed otherwise: no Upon is due for it.
    pub(super) fn served_upons(&mut self, var: crate::lang::VarId, value: f64) {
        for (upon, used) in self.program.upons.iter().zip(&mut self.upon_used) {
            if upon.var == var && !upon.every {
                *used = Some(value);
            }
        }
    }

    /// Runs a sequence after the Upon sequences of the variables that it prints.
    pub(super) fn run_with_upons(&mut self, block: &Block) -> Done {
        self.upons(block.vars)?;
        self.run_block(block)
    }

    /// Before these variables are used: prints the Upon sequences that are due. Their bodies trigger none.
    pub(super) fn upons(&mut self, used: VarSet) -> Done {
        let program = self.program;
        if !program.upon_vars.meets(used) {
            return Ok(());
        }
        for (i, upon) in program.upons.iter().enumerate() {
            if !used.has(upon.var) {
                continue;
            }
            let Some(value) = self.vars.get(upon.var) else { continue };
            let before = self.upon_used[i].replace(value);
            // the first use only sets the baseline, unless it prints at every use
            let due = if upon.every { true } else { before.is_some_and(|before| before != value) };
            if due {
                self.run_block(&upon.block)?;
                if self.names_axes(&upon.block) {
                    self.upon_moved = Some(upon.block.span);
                }
            }
        }
        Ok(())
    }
}
