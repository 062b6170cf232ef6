//! Words with calculated values, and lists of tools, operations or work offsets.

use super::{Body, FEEDS, go_on};
use crate::compile::{LetterKind, List};
use crate::diag::Code;
use crate::lang::{VarId, VarSet};
use crate::render::ahead;
use crate::render::cx::Writer;
use crate::render::fault::{Done, fault};
use crate::render::no_value::division_by_zero;
use crate::render::numbers::quantised;
use crate::render::said::CONDITIONS;
use crate::render::words::check_feed;
use crate::sema::Without;

impl Body<'_> {
    /// Prints the lines of a list once for each tool, operation or work offset of the job.
    #[cold]
    pub(super) fn list(&mut self, index: usize) -> Done {
        self.end_line();
        let List { each, routine } = &self.writer.shape.program.lists[index];
        let Some(survey) = self.writer.shape.options.survey.clone() else {
            let message = format!("the list of {}s of the job is unknown", each.name());
            return fault(Code::PR052, message, "the job must be read twice: give it as a file, without `--stream`");
        };
        for item in ahead::items(*each, self.writer.want.item, &survey) {
            let want = ahead::of_item(item, &survey, self.writer.shape, self.writer.want);
            let way = self.writer.shape.way(routine, &want, self.writer.said);
            let mode = self.mode;
            go_on(way, way.ops.clone(), mode, &mut Writer { want: &want, ..self.writer.lend() })?;
        }
        Ok(())
    }

    /// Executes `@set`: assigns a value to a variable or a property.
    pub(super) fn set(&mut self, index: u32) -> Done {
        let (target, formula) = self.writer.shape.program.sets[index as usize];
        let value = match self.writer.shape.program.formulas[formula as usize].value(&self.now(b' ')) {
            Ok(value) => value.into_owned(),
            Err(Without::Divisor(divisor)) => return Err(Box::new(division_by_zero(divisor))),
            Err(Without::Value(var)) => {
                self.value_of(var, b' ')?;
                // without a value, skipping `@set` would keep the old value of the variable
                let message = format!("[{}] has no value here, but @set needs one", var.name());
                return fault(
                    Code::PR001,
                    message,
                    format!("use `@set` only if there is a value: `@if [{}]`", var.name()),
                );
            }
        };
        self.writer.said.kept.set(target, value);
        Ok(())
    }

    /// A calculated value; `None` if one of its variables has no value and the word is optional.
    pub(super) fn calculated(&self, index: u32, letter: u8) -> Done<Option<f64>> {
        match self.writer.shape.program.formulas[index as usize].number(&self.now(letter)) {
            Ok(value) => Ok(Some(value)),
            Err(Without::Value(var)) => self.value_of(var, letter),
            Err(Without::Divisor(divisor)) => Err(Box::new(division_by_zero(divisor))),
        }
    }

    /// The only variable of the calculated value, with the job's value for this variable. `None`: there are several
    /// variables, or the variable is not a condition of the control, such as the work offset.
    fn condition_of(&self, vars: VarSet, letter: u8) -> Done<Option<(VarId, f64)>> {
        match CONDITIONS.into_iter().find(|&var| vars == VarSet::of(&[var])) {
            Some(var) => Ok(self.value_of(var, letter)?.map(|own| (var, own))),
            None => Ok(None),
        }
    }

    /// Prints a calculated value without a letter. After a text, such a value may also set a condition of the control.
    pub(super) fn bare_formula(&mut self, index: u32, glued: bool) -> Done {
        let Some(value) = self.calculated(index, b' ')? else { return Ok(()) };
        let condition = self.condition_of(self.writer.shape.program.formulas[index as usize].vars(), b' ')?;
        if let Some((var, own)) = condition {
            self.counts_from(b' ', var, own);
        }
        self.writer.out.bare(value, &self.writer.shape.letters.bare, glued)?;
        if let Some((var, own)) = condition {
            self.condition_word(b' ', var, own);
        }
        Ok(())
    }

    /// Prints a letter and a calculated value. A calculated axis position is treated like a typed position, because the
    /// position may be in another coordinate frame. A word that is calculated from one condition alone, such as
    /// `H[work-53]`, counts as printing this condition. The job's value for the condition is then not printed again.
    pub(super) fn formula_word(&mut self, letter: u8, index: u32, glued: bool) -> Done {
        let shape = self.writer.shape;
        let info = &shape.letters[letter];
        let Some(value) = self.calculated(index, letter)? else { return Ok(()) };
        let vars = shape.program.formulas[index as usize].vars();
        let condition = self.condition_of(vars, letter)?;
        if let Some((var, own)) = condition {
            self.counts_from(letter, var, own);
        }
        let units = quantised(info, value)?;
        if let Some(var) = FEEDS.iter().find(|&var| vars.has(var)) {
            check_feed(info, var, value, units, self.writer.want, self.writer.out)?;
        }
        if self.drops_word(letter, None, value, units) {
            return Ok(());
        }
        self.print(letter, value, units, glued)?;
        if info.kind == LetterKind::Axis {
            self.writer.said.forget(info);
            self.writer.said.displaced(shape.axis_bit(letter), shape);
        }
        match condition {
            Some((var, own)) => self.condition_word(letter, var, own),
            None => self.writer.said.speed_word(letter, value, self.line(), self.writer.want, shape),
        }
        Ok(())
    }

    /// Prints a value in a comment; an unknown value is printed as `-`.
    pub(super) fn remark(&mut self, value: Done<Option<f64>>, glued: bool) -> Done {
        match value {
            Ok(Some(value)) => self.writer.out.bare(value, &self.writer.shape.letters.bare, glued),
            Ok(None) => Ok(()),
            Err(diag) if diag.code == Code::PR001 => {
                self.writer.out.word(glued).push(b'-');
                Ok(())
            }
            Err(diag) => Err(diag),
        }
    }
}
