//! What is in force between two blocks, for whoever puts it in force again.

use super::action::{Position, Rotation};
use super::frames::Shift;
use super::state::State;
use crate::control::Meaning;
use crate::toolpath::{FeedMode, Plane, Units};

/// What is in force between two blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// In program coordinates and the units in force.
    pub position: Position,
    /// Axes whose position only the machine knows, as bits.
    pub unknown: u8,
    /// Those of them that stand at a place of the machine that the program said.
    pub said: u8,
    /// The units in force.
    pub units: Units,
    /// The plane of arcs.
    pub plane: Plane,
    /// Axis words are positions.
    pub absolute: bool,
    /// What feeds count.
    pub feed_mode: FeedMode,
    /// The feed in the unit of its mode; 0 where none is known.
    pub feed: f64,
    /// Cycles return to the initial level.
    pub to_initial: bool,
    /// What the spindle does.
    pub rotation: Rotation,
    /// Its speed.
    pub speed: f64,
    /// What T said last.
    pub named_tool: Option<f64>,
    /// The tool in the spindle.
    pub tool: Option<f64>,
    /// Cutter compensation is on.
    pub compensated: bool,
    /// The motion in force is a rapid.
    pub is_rapid: bool,
    /// It is a straight cut.
    pub is_line: bool,
    /// A canned cycle is in force.
    pub has_cycle: bool,
    /// The number of the work offset.
    pub work: usize,
    /// A frame is moved by G52 or G92, or turned.
    pub is_shifted: bool,
}

impl State {
    /// What is in force.
    pub fn standing(&self) -> Standing {
        Standing {
            position: self.place.position,
            unknown: self.place.at_machine,
            said: self.place.placed,
            units: self.modes.units,
            plane: self.modes.plane,
            absolute: self.modes.absolute,
            feed_mode: self.modes.feed_mode,
            feed: self.drive.feed,
            to_initial: self.modes.to_initial,
            rotation: self.drive.spindle,
            speed: self.drive.speed,
            named_tool: self.tool.number,
            tool: self.tool.loaded,
            compensated: self.tool.side.is_some(),
            is_rapid: self.modes.motion.is_some_and(|row| row.meaning == Meaning::Rapid),
            is_line: self.modes.motion.is_some_and(|row| row.meaning == Meaning::Line),
            has_cycle: self.cycle_in_force().is_some(),
            work: self.place.frames.active,
            is_shifted: self.place.frames.shift != Shift::default() || self.place.frames.angle() != 0.0,
        }
    }
}
