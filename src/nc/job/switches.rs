//! What is switched on a machine: spindle, coolant, work offset. A job says it with the move after.

use crate::nc::action::{Cooling, Rotation};
use crate::toolpath::{Coolant, Event, Spindle, SpindleTurn};

/// What is switched on a machine, for comparison: what was said, and what is wanted now.
#[derive(Clone, Copy, PartialEq, Default)]
pub(super) struct Switches {
    pub rotation: Option<Rotation>,
    pub speed: Option<f64>,
    pub css: Option<bool>,
    /// Highest speed of a lathe's spindle.
    pub limit: Option<f64>,
    pub coolant: Option<Coolant>,
    pub work: Option<f64>,
}

impl Switches {
    /// Takes a coolant code. `false`: flood and mist would be on together, and a job has one of them, the later.
    pub fn cool(&mut self, cooling: Cooling) -> bool {
        let wanted = match cooling {
            Cooling::Flood => Coolant::FLOOD,
            Cooling::Mist => Coolant::MIST,
            Cooling::Off => Coolant::OFF,
        };
        let before = self.coolant.replace(wanted);
        let flows = |coolant| matches!(coolant, Coolant::FLOOD | Coolant::MIST);
        !flows(wanted) || before.is_none_or(|before| !flows(before) || before == wanted)
    }

    /// The spindle as a job says it.
    pub fn spindle(&self) -> Spindle {
        Spindle {
            // a standing spindle's zero is no speed
            speed: self.speed.filter(|&speed| speed > 0.0 || self.turns()),
            turn: Some(match self.rotation {
                Some(Rotation::Cw) => SpindleTurn::Cw,
                Some(Rotation::Ccw) => SpindleTurn::Ccw,
                Some(Rotation::Stop) | None => SpindleTurn::Off,
            }),
            css: self.css,
            max: self.limit,
        }
    }

    /// What is to be said where this was said and that is wanted.
    pub fn changes(self, wanted: Switches) -> impl Iterator<Item = Event<'static>> {
        let of_spindle = |at: &Switches| (at.rotation, at.speed, at.css, at.limit);
        let spindle = (of_spindle(&self) != of_spindle(&wanted)).then(|| Event::Spindle(wanted.spindle()));
        let coolant = wanted.coolant.filter(|_| self.coolant != wanted.coolant).map(Event::Coolant);
        let work = wanted.work.filter(|_| self.work != wanted.work).map(Event::Work);
        [spindle, coolant, work].into_iter().flatten()
    }

    /// Does the spindle turn?
    pub fn turns(&self) -> bool {
        matches!(self.rotation, Some(Rotation::Cw | Rotation::Ccw))
    }
}
