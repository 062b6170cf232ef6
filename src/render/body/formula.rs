//! Words whose values are calculated, and lists of what lies ahead.

use super::{Body, FEEDS, Mode, go_on};
use crate::compile::{LetterKind, List};
use crate::control;
use crate::diag::Code;
use crate::lang::{VarId, VarSet};
use crate::render::ahead;
use crate::render::fault::{Done, fault};
use crate::render::numbers::quantised;
use crate::render::ways::division_by_zero;
use crate::render::words::check_feed;
use crate::sema::{Value, Without};

impl Body<'_, '_> {
    /// Lines that print once for each tool, operation or work offset of the job.
    #[cold]
    pub(super) fn list(&mut self, index: usize) -> Done {
        self.end_line();
        let List { each, routine } = &self.shape.program.lists[index];
        let Some(survey) = self.shape.options.survey.clone() else {
            let message = format!("the {}s of the job are not known", each.name());
            return fault(Code::PR052, message, "let the job be read twice: give it as a file, without `--stream`");
        };
        for item in ahead::items(*each, self.want.item, &survey) {
            let want = ahead::of_item(item, &survey, self.shape, self.want);
            let way = self.shape.way(routine, &want, self.said);
            go_on(way, way.ops.clone(), self.mode, self.shape, &want, self.said, self.out)?;
        }
        Ok(())
    }

    /// A directive gives a variable or a property its value.
    pub(super) fn set(&mut self, index: u32) -> Done {
        let (target, formula) = self.shape.program.sets[index as usize];
        if let Some(value) = self.to_keep(formula)? {
            self.said.kept.set(target, value);
        }
        Ok(())
    }

    /// A calculated value, or none where the word of a variable in it is optional.
    pub(super) fn calculated(&self, index: u32, letter: u8) -> Done<Option<f64>> {
        match self.shape.program.formulas[index as usize].number(&self.now(letter)) {
            Ok(value) => Ok(Some(value)),
            Err(Without::Value(var)) => self.value_of(var, letter),
            Err(Without::Divisor(divisor)) => Err(Box::new(division_by_zero(divisor))),
        }
    }

    /// What `@set` gives a value, or none where a variable in it has none and its word is optional.
    pub(super) fn to_keep(&self, index: u32) -> Done<Option<Value<'static>>> {
        match self.shape.program.formulas[index as usize].value(&self.now(b' ')) {
            Ok(value) => Ok(Some(value.into_owned())),
            Err(_) => Ok(self.calculated(index, b' ')?.map(Value::Number)),
        }
    }

    /// A letter and a calculated value. On an axis the control counts it like a typed one: it may stand in another frame.
    pub(super) fn formula_word(&mut self, letter: u8, index: u32, glued: bool) -> Done {
        let (shape, settings) = (self.shape, &self.shape.program.settings);
        let info = &shape.letters[letter];
        let Some(value) = self.calculated(index, letter)? else { return Ok(()) };
        let units = quantised(info, value)?;
        if let Some(var) = FEEDS.iter().find(|&var| shape.program.formulas[index as usize].vars().has(var)) {
            check_feed(info, var, value, units, self.want, self.out)?;
        }
        let feed = self.want.inverse_time() && letter == settings.feed_code;
        let drops = match self.mode {
            Mode::All => false,
            Mode::Motion | Mode::ArcMotion => match info.kind {
                LetterKind::GCode | LetterKind::MCode => {
                    control::Code::of(info.printed, value).is_some_and(|code| self.said.code_drops(code, shape))
                }
                // a centre or radius is no position that the control keeps
                _ if self.mode == Mode::ArcMotion && b"IJKR".contains(&info.printed) => false,
                _ => info.modal && self.said.holds(info, units) && !feed,
            },
            Mode::NextHole { .. } => settings.modality && self.said.holds_value(info, units, value),
            Mode::Hole => self.drops && self.said.holds_value(info, units, value),
        };
        if drops {
            return Ok(());
        }
        self.out.letter(info, units, glued)?;
        match info.kind {
            LetterKind::GCode | LetterKind::MCode => {
                self.said.code_word(info, value, self.line(), self.want, shape);
            }
            LetterKind::Axis => {
                self.said.forget(info);
                self.said.displaced(shape.axis_bit(letter), shape);
            }
            LetterKind::Other => self.said.word(info, units),
        }
        if Some(info.printed) == settings.numbers.letter {
            self.out.prints_number();
        }
        // what a form makes of the job's speed is its speed: the job's own is not said behind it
        let own = self.want.get(VarId::Speed).filter(|_| {
            letter == settings.speed_code
                && shape.program.formulas[index as usize].vars() == VarSet::of(&[VarId::Speed])
        });
        self.said.speed_word(letter, own.or(Some(value)), shape);
        Ok(())
    }

    /// A value in a comment, which says what is known.
    pub(super) fn remark(&mut self, value: Done<Option<f64>>, glued: bool) -> Done {
        match value {
            Ok(Some(value)) => self.out.bare(value, &self.shape.letters.bare, glued),
            Ok(None) => Ok(()),
            Err(diag) if diag.code == Code::PR001 => {
                self.out.word(glued).push(b'-');
                Ok(())
            }
            Err(diag) => Err(diag),
        }
    }
}
