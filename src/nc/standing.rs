//! The state in force between two blocks, for putting it in force again.

use super::action::{Position, Rotation};
use super::frames::Shift;
use super::state::State;
use crate::control::Meaning;
use crate::toolpath::{FeedMode, Plane, Units};

/// The state in force between two blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// Position in program coordinates and the units in force.
    pub position: Position,
    /// Axes whose position is known only at the machine, as bits.
    pub unknown: u8,
    /// Those of the `unknown` axes whose machine position is given in the program.
    pub said: u8,
    /// The units in force.
    pub units: Units,
    /// The plane of arcs.
    pub plane: Plane,
    /// Whether axis words are positions.
    pub absolute: bool,
    /// The feed mode.
    pub feed_mode: FeedMode,
    /// The feed in the unit of its mode; 0 if none is known.
    pub feed: f64,
    /// Whether cycles return to the initial level.
    pub to_initial: bool,
    /// Rotation of the spindle.
    pub rotation: Rotation,
    /// Speed of the spindle.
    pub speed: f64,
    /// The tool of the last T word.
    pub named_tool: Option<f64>,
    /// The tool in the spindle.
    pub tool: Option<f64>,
    /// Whether cutter compensation is on.
    pub compensated: bool,
    /// Whether the motion in force is a rapid.
    pub is_rapid: bool,
    /// Whether the motion in force is a straight cut.
    pub is_line: bool,
    /// Whether a canned cycle is in force.
    pub has_cycle: bool,
    /// The number of the work offset.
    pub work: usize,
    /// Whether a frame is moved by G52 or G92, or rotated.
    pub is_shifted: bool,
}

impl State {
    /// The state in force.
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
