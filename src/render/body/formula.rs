//! Words whose values are calculated, and lists of what lies ahead.

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
    /// Lines that print once for each tool, operation or work offset of the job.
    #[cold]
    pub(super) fn list(&mut self, index: usize) -> Done {
        self.end_line();
        let List { each, routine } = &self.writer.shape.program.lists[index];
        let Some(survey) = self.writer.shape.options.survey.clone() else {
            let message = format!("the {}s of the job are not known", each.name());
            return fault(Code::PR052, message, "let the job be read twice: give it as a file, without `--stream`");
        };
        for item in ahead::items(*each, self.writer.want.item, &survey) {
            let want = ahead::of_item(item, &survey, self.writer.shape, self.writer.want);
            let way = self.writer.shape.way(routine, &want, self.writer.said);
            let mode = self.mode;
            go_on(way, way.ops.clone(), mode, &mut Writer { want: &want, ..self.writer.lend() })?;
        }
        Ok(())
    }

    /// A directive gives a variable or a property its value.
    pub(super) fn set(&mut self, index: u32) -> Done {
        let (target, formula) = self.writer.shape.program.sets[index as usize];
        let value = match self.writer.shape.program.formulas[formula as usize].value(&self.now(b' ')) {
            Ok(value) => value.into_owned(),
            Err(Without::Divisor(divisor)) => return Err(Box::new(division_by_zero(divisor))),
            Err(Without::Value(var)) => {
                self.value_of(var, b' ')?;
                // a word is left out then; what was set before would stay
                let message = format!("[{}] has no value here, and @set takes one", var.name());
                return fault(Code::PR001, message, format!("set it where there is one: `@if [{}]`", var.name()));
            }
        };
        self.writer.said.kept.set(target, value);
        Ok(())
    }

    /// A calculated value, or none where the word of a variable in it is optional.
    pub(super) fn calculated(&self, index: u32, letter: u8) -> Done<Option<f64>> {
        match self.writer.shape.program.formulas[index as usize].number(&self.now(letter)) {
            Ok(value) => Ok(Some(value)),
            Err(Without::Value(var)) => self.value_of(var, letter),
            Err(Without::Divisor(divisor)) => Err(Box::new(division_by_zero(divisor))),
        }
    }

    /// The condition that a value is made of alone, with the job's value of it.
    fn condition_of(&self, vars: VarSet, letter: u8) -> Done<Option<(VarId, f64)>> {
        match CONDITIONS.into_iter().find(|&var| vars == VarSet::of(&[var])) {
            Some(var) => Ok(self.value_of(var, letter)?.map(|own| (var, own))),
            None => Ok(None),
        }
    }

    /// A calculated value without a letter: after a text it may print a condition too.
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

    /// A letter and a calculated value. On an axis the control counts it like a typed one: it may stand in another frame.
    /// What a form makes of a condition alone, as `H[work-53]`, is the form's own value: the job's value is not printed after it.
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

    /// A value in a comment, which says what is known.
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
