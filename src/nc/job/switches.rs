//! Switches of a machine: spindle, coolant, work offset. A job sets them with the move that follows.

use crate::nc::action::{Cooling, Rotation};
use crate::toolpath::{Coolant, Event, Spindle, SpindleTurn};

/// Switches of a machine. The events given so far and the state now required are compared by these values.
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
    /// Takes a coolant code. Returns `false` if flood and mist would both be on. A job has only one of them: the later.
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

    /// The spindle as an event of a job has it.
    pub fn spindle(&self) -> Spindle {
        Spindle {
            // a speed of zero while the spindle is stopped is not a speed
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

    /// The events that change these switches to `wanted`.
    pub fn changes(self, wanted: Switches) -> impl Iterator<Item = Event<'static>> {
        let of_spindle = |at: &Switches| (at.rotation, at.speed, at.css, at.limit);
        let spindle = (of_spindle(&self) != of_spindle(&wanted)).then(|| Event::Spindle(wanted.spindle()));
        let coolant = wanted.coolant.filter(|_| self.coolant != wanted.coolant).map(Event::Coolant);
        let work = wanted.work.filter(|_| self.work != wanted.work).map(Event::Work);
        [spindle, coolant, work].into_iter().flatten()
    }

    /// Whether the spindle turns.
    pub fn turns(&self) -> bool {
        matches!(self.rotation, Some(Rotation::Cw | Rotation::Ccw))
    }
}
