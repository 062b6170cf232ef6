//! The words of generated blocks: axes, increments, motion codes, the feed.

use super::fault::{Done, fault};
use super::numbers::quantised;
use super::renderer::Renderer;
use crate::compile::LetterKind;
use crate::diag::Code;
use crate::lang::VarId;
use crate::sema;
use crate::toolpath::Axes;

/// A target in units of its letters.
#[derive(Default)]
pub(super) struct AxisUnits {
    pub(super) units: [i64; 6],
    /// Axes that differ from what was printed.
    pub(super) changed: u8,
    /// Those, and the ones that may not be dropped.
    pub(super) prints: u8,
}

impl Renderer<'_> {
    /// A target in units of its letters, and what of it must be printed.
    #[inline]
    pub(super) fn axis_units(&self, target: &Axes, found: &mut AxisUnits) -> Done {
        let mut axes = target.given;
        while axes != 0 {
            let axis = axes.trailing_zeros() as usize;
            axes &= axes - 1;
            let info = &self.shape.letters[self.shape.axes[axis]];
            let units = quantised(info, target.values[axis] * self.shape.scales[axis])?;
            found.units[axis] = units;
            let changed = !self.registers.holds(info.printed, units, info.format.dec.count);
            found.changed |= u8::from(changed) << axis;
            found.prints |= u8::from(changed || !info.modal) << axis;
        }
        Ok(())
    }

    /// The words of the axes that must be printed.
    #[inline]
    pub(super) fn axis_words(&mut self, target: &Axes, axes: &AxisUnits) -> Done {
        if self.shape.program.settings.incremental {
            return self.increments(target, axes.prints);
        }
        let mut left = axes.prints;
        while left != 0 {
            let axis = left.trailing_zeros() as usize;
            left &= left - 1;
            let info = &self.shape.letters[self.shape.axes[axis]];
            self.out.letter(info, axes.units[axis], false)?;
            self.registers.set(info.printed, axes.units[axis], info.format.dec.count);
        }
        Ok(())
    }

    /// Does a target differ from the tool's position in what would be printed? An increment of zero is no move, also
    /// where the letter's last value is unknown.
    #[cold]
    pub(super) fn has_increment(&self, target: &Axes) -> Done<bool> {
        for axis in 0..6 {
            let (Some(from), Some(to)) = (self.position.get(axis), target.get(axis)) else {
                if target.get(axis).is_some() {
                    return Ok(true);
                }
                continue;
            };
            let (info, scale) = (&self.shape.letters[self.shape.axes[axis]], self.shape.scales[axis]);
            if quantised(info, from * scale)? != quantised(info, to * scale)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Increments between printed positions, so that they add up without a rest.
    fn increments(&mut self, target: &Axes, axes: u8) -> Done {
        for axis in 0..6 {
            if axes & 1 << axis == 0 {
                continue;
            }
            let info = &self.shape.letters[self.shape.axes[axis]];
            let Some(from) = self.position.get(axis) else {
                return fault(
                    Code::PR001,
                    format!("an increment of {} from an unknown position", char::from(info.printed)),
                    "a tool change that prints the position makes it known; a new work offset or a literal axis word does not",
                );
            };
            let scale = self.shape.scales[axis];
            let (from, to) = (quantised(info, from * scale)?, quantised(info, target.values[axis] * scale)?);
            if to != from {
                self.out.letter(info, to - from, false)?;
            }
            self.registers.set(info.printed, to, info.format.dec.count);
        }
        Ok(())
    }

    /// The motion code, unless it is in force and may be dropped.
    #[inline]
    pub(super) fn motion_word(&mut self, code: &sema::Code) -> Done {
        if self.code_drops(code.letter, code.value) {
            return Ok(());
        }
        self.code_word(code)
    }

    /// A code, as typed in its command or by its letter's format.
    pub(super) fn code_word(&mut self, code: &sema::Code) -> Done {
        let info = &self.shape.letters[code.letter];
        match &code.text {
            Some(text) => self.out.text(text, false),
            None => {
                let units = quantised(info, code.value)?;
                self.out.letter(info, units, false)?;
            }
        }
        if matches!(info.kind, LetterKind::GCode | LetterKind::MCode) {
            self.printed_code(info.printed, code.value);
        }
        Ok(())
    }

    /// A word that belongs to the code before it: the time of a dwell, the angle of an orientation. Its letter may
    /// be that of an axis, the feed or the speed, whose value is then unknown rather than this one.
    pub(super) fn parameter_word(&mut self, letter: u8, value: f64) -> Done {
        self.letter_word(letter, value)?;
        self.registers.forget(self.shape.letters[letter].printed);
        if letter == self.shape.program.settings.speed_code {
            self.served.speed = None;
        }
        Ok(())
    }

    /// The word of one axis, always printed.
    pub(super) fn axis_word(&mut self, axis: usize, target: &Axes) -> Done {
        self.letter_word(self.shape.axes[axis], target.values[axis] * self.shape.scales[axis])
    }

    /// A letter with a value, always printed.
    pub(super) fn letter_word(&mut self, letter: u8, value: f64) -> Done {
        let info = &self.shape.letters[letter];
        let units = quantised(info, value)?;
        self.out.letter(info, units, false)?;
        self.registers.set(info.printed, units, info.format.dec.count);
        Ok(())
    }

    /// The feed, when it changed; in inverse time always.
    #[inline]
    pub(super) fn feed_word(&mut self) -> Done {
        let info = &self.shape.letters[self.shape.program.settings.feed_code];
        if let Some(units) = self.feed_units
            && self.registers.holds(info.printed, units, info.format.dec.count)
            && info.modal
            && !self.inverse_time()
        {
            return Ok(());
        }
        let Some(feed) = self.feed else { return Ok(()) };
        let units = quantised(info, feed)?;
        self.check_feed(info, VarId::Frate, feed, units)?;
        self.out.letter(info, units, false)?;
        self.registers.set(info.printed, units, info.format.dec.count);
        Ok(())
    }
}
