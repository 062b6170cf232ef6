//! The switches of a machine: spindle, coolant, work offset. In a job, events before the next move set these switches.

use crate::nc::action::Rotation;
use crate::toolpath::{Coolant, Event, Spindle};

/// The switches of a machine. The reader compares the state that its events have set with the state that the program requires.
#[derive(Clone, Copy, PartialEq, Default)]
pub(super) struct Switches {
    pub rotation: Option<Rotation>,
    pub speed: Option<f64>,
    pub css: Option<bool>,
    /// Maximum spindle speed of a lathe.
    pub limit: Option<f64>,
    pub coolant: Option<Coolant>,
    pub work: Option<f64>,
}

impl Switches {
    /// Handles a code that turns on this kind of coolant, or all kinds off. Returns `false` if both flood and mist would be
    /// on. A job can have only one of the two, and gets the later one.
    pub fn cool(&mut self, kind: Coolant) -> bool {
        let before = self.coolant.unwrap_or_default();
        let after = before.then(kind);
        self.coolant = Some(after);
        kind == Coolant::OFF || after.is_same(before.and(kind))
    }

    /// The state of the spindle as an event of a job contains it.
    pub fn spindle(&self) -> Spindle {
        Spindle {
            // a speed of 0 with a stopped spindle is left out
            speed: self.speed.filter(|&speed| speed > 0.0 || self.turns()),
            turn: Some(self.rotation.unwrap_or(Rotation::Stop).turn()),
            css: self.css,
            max: self.limit,
        }
    }

    /// The events that change the state from these switches to `wanted`.
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
