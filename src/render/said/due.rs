//! Conditions that must be active at the next move: the job's values, or the form's own values for conditions that the
//! job does not set.

use super::conditions::Conditions;
use super::line::Line;
use super::state::Said;
use crate::lang::{Machine, VarId};
use crate::render::shape::Shape;
use crate::render::want::Want;
use crate::span::Span;

impl Said {
    /// The value that must be active at the next move: the job's value, or the form's own value if the job has no
    /// value.
    pub fn due(&self, var: VarId, want: &Want) -> Option<f64> {
        let own = match var {
            VarId::Cool => self.own.cool.filter(|_| !want.coolant_is_said),
            VarId::Speed => self.own.speed.filter(|(_, job)| want.get(var) == Some(*job)).map(|(own, _)| own),
            _ => None,
        };
        own.or(want.get(var))
    }

    /// Records a printed code of coolant.
    pub(super) fn coolant_said(&mut self, code: f64, line: Line, want: &Want, shape: &Shape) {
        self.conditions.put(VarId::Cool, Some(code));
        if !line.is_generated() {
            self.own.cool = Some(code).filter(|_| !want.coolant_is_said);
        }
        self.typed(VarId::Cool, code, line, want, shape);
    }

    /// Records that a line of the form set a condition, if the value differs from the job's value. An "off" value never
    /// counts as a difference.
    pub(super) fn typed(&mut self, var: VarId, value: f64, line: Line, want: &Want, shape: &Shape) {
        let settings = &shape.program.settings;
        let off = match var {
            VarId::Cool => settings.coolant[1],
            VarId::Direct => settings.spindle[2],
            _ => 0.0,
        };
        let other = value != off && self.due(var, want).is_some_and(|due| due != value);
        let at = line.span(shape).filter(|_| other);
        self.own.typed.put(var, at.map(|_| value));
        self.own.line = at.or(self.own.line);
    }

    /// Records that a word printed the job's speed, which replaces the form's own speed.
    pub(super) fn speed_is_the_jobs(&mut self) {
        self.own.speed = None;
    }

    /// Keeps the speed that the tool change printed until the job gives another speed. The speed is kept only on mills,
    /// because on a lathe a typed S may be a speed limit.
    pub fn keep_speed_of_change(&mut self, want: &Want, shape: &Shape) {
        let printed = self.conditions.get(VarId::Speed).filter(|own| *own > 0.0);
        let mill = shape.program.settings.machine == Machine::Mill;
        let both = printed.zip(want.get(VarId::Speed)).filter(|(own, job)| mill && own != job);
        self.own.speed = both;
        if both.is_some() {
            self.own.typed.put(VarId::Speed, None);
        }
    }

    /// Takes the value of a condition that a line set to another value than the job, with the location of the line.
    pub fn take_typed(&mut self, var: VarId) -> Option<(f64, Option<Span>)> {
        let typed = self.own.typed.get(var)?;
        self.own.typed.put(var, None);
        Some((typed, self.own.line))
    }

    /// Called after all conditions were checked. If the job sets the coolant itself, the form's own coolant value is
    /// dropped.
    pub fn conditions_are_settled(&mut self, want: &Want) {
        self.own.typed = Conditions::default();
        if want.coolant_is_said {
            self.own.cool = None;
        }
    }
}
