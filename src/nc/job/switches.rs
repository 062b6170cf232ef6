//! What is switched on a machine: spindle, coolant, work offset. A job says it with the move after.

use crate::nc::action::{Cooling, Rotation};
use crate::toolpath::{Coolant, Spindle, SpindleTurn};

/// What is switched on a machine, for comparison: what was said, and what is wanted now.
#[derive(Clone, Copy, PartialEq, Default)]
pub(super) struct Switches {
    pub rotation: Option<Rotation>,
    pub speed: Option<f64>,
    pub css: Option<bool>,
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
            max: None,
        }
    }

    /// Does the spindle turn?
    pub fn turns(&self) -> bool {
        matches!(self.rotation, Some(Rotation::Cw | Rotation::Ccw))
    }
}
