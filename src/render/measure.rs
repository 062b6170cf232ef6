//! What is measured along the way: lengths and times for forms that print them, and travel limits.

use super::fault::{Done, fault_at};
use super::renderer::Renderer;
use super::vars::Vars;
use crate::diag::Code;
use crate::lang::{VarId, VarSet};
use crate::toolpath::{Axes, FeedMode};

/// Variables that need the length of each move.
pub(super) const MEASURES: VarSet =
    VarSet::of(&[VarId::Movelength, VarId::Movetime, VarId::Totalcutdist, VarId::Totalcuttime, VarId::Invtime]);

impl Renderer<'_> {
    /// Lengths and times, for forms that print them.
    #[cold]
    pub(super) fn measure(&mut self, target: &Axes, cuts: bool) {
        let mut square = 0.0;
        for axis in 0..3 {
            if let (Some(from), Some(to)) = (self.position.get(axis), target.get(axis)) {
                square += (to - from) * (to - from);
            }
        }
        self.measured(square.sqrt(), cuts);
    }

    /// The same for a length that is known.
    pub(super) fn measured(&mut self, length: f64, cuts: bool) {
        self.vars.set(VarId::Movelength, length);
        let Some(feed) = self.feed.filter(|_| cuts) else { return };
        let minutes = match self.feed_mode {
            FeedMode::PerMinute => length / feed,
            FeedMode::PerRev => length / (feed * self.vars.get(VarId::Speed).unwrap_or(0.0)),
            FeedMode::InverseTime => 1.0 / feed,
        };
        if !minutes.is_finite() {
            return;
        }
        self.vars.set(VarId::Movetime, minutes * 60.0);
        if minutes > 0.0 {
            self.vars.set(VarId::Invtime, 1.0 / minutes);
        }
        let add = |vars: &mut Vars, var, value: f64| {
            let sum = vars.get(var).unwrap_or(0.0) + value;
            vars.set(var, sum);
        };
        add(&mut self.vars, VarId::Totalcutdist, length);
        add(&mut self.vars, VarId::Totalcuttime, minutes * 60.0);
    }

    /// Travel limits of the form.
    #[cold]
    pub(super) fn check_limits(&self, target: &Axes) -> Done {
        for limit in &self.shape.program.settings.limits {
            let Some(axis) = self.shape.axes.iter().position(|&letter| letter == limit.letter) else { continue };
            let Some(value) = target.get(axis).map(|value| value * self.shape.scales[axis]) else { continue };
            let scale = if axis < self.shape.linear { self.shape.form_scale } else { 1.0 };
            let (least, greatest) = (limit.least * scale, limit.greatest * scale);
            if value < least || value > greatest {
                let letter = char::from(limit.letter);
                let message = format!("{letter}{value:.4} is beyond the travel from {least} to {greatest}");
                return fault_at(Code::PR007, message, "move the part, or mend `Limits` in the form", Some(limit.span));
            }
        }
        Ok(())
    }
}
