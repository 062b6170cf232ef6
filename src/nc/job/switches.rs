//! What is switched on a machine: spindle, coolant, work offset. A job says it with the move after.

use super::reader::Reader;
use super::{Done, warning};
use crate::nc::action::{Cooling, Rotation};
use crate::toolpath::{Coolant, Event, Spindle, SpindleTurn};

/// What is switched on a machine, for comparison: what was said, and what is wanted now.
#[derive(Clone, Copy, PartialEq, Default)]
pub(super) struct Switches {
    pub rotation: Option<Rotation>,
    pub speed: Option<f64>,
    pub css: Option<bool>,
    pub coolant: Option<Coolant>,
    pub work: Option<f64>,
}

impl Reader<'_> {
    /// A job has flood or mist.
    pub(super) fn coolant(&mut self, cooling: Cooling) {
        let both = [Some(Coolant::On), Some(Coolant::Mist)];
        let wanted = if cooling == Cooling::Flood { Coolant::On } else { Coolant::Mist };
        if cooling != Cooling::Off && both.contains(&self.wanted.coolant) && self.wanted.coolant != Some(wanted) {
            let message = "flood and mist at once: a job has one of them, the later";
            self.warnings.push(warning(self.place.line, message, "print the other by the form"));
        }
        self.wanted.coolant = Some(match cooling {
            Cooling::Flood => Coolant::On,
            Cooling::Mist => Coolant::Mist,
            Cooling::Off => Coolant::Off,
        });
    }

    pub(super) fn spindle(&self) -> Spindle {
        Spindle {
            // a standing spindle's zero is no speed
            speed: self.wanted.speed.filter(|&speed| speed > 0.0 || self.turns()),
            turn: Some(match self.wanted.rotation {
                Some(Rotation::Cw) => SpindleTurn::Cw,
                Some(Rotation::Ccw) => SpindleTurn::Ccw,
                Some(Rotation::Stop) | None => SpindleTurn::Off,
            }),
            css: self.wanted.css,
            max: None,
        }
    }

    pub(super) fn turns(&self) -> bool {
        matches!(self.wanted.rotation, Some(Rotation::Cw | Rotation::Ccw))
    }

    /// What was switched since the last move.
    pub(super) fn switch(&mut self) -> Done {
        if self.said == self.wanted {
            return Ok(());
        }
        let (said, wanted) = (self.said, self.wanted);
        self.said = wanted;
        if (said.rotation, said.speed, said.css) != (wanted.rotation, wanted.speed, wanted.css) {
            self.push(Event::Spindle(self.spindle()))?;
        }
        if let Some(coolant) = wanted.coolant.filter(|_| said.coolant != wanted.coolant) {
            self.push(Event::Coolant(coolant))?;
        }
        match wanted.work.filter(|_| said.work != wanted.work) {
            Some(work) => self.push(Event::Work(work)),
            None => Ok(()),
        }
    }
}
