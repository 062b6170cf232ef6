//! The state that is active between two blocks. postform uses this data to restore the state in another program.

use super::action::{Position, Rotation};
use super::frames::Shift;
use super::state::State;
use crate::control::Meaning;
use crate::toolpath::{FeedMode, Plane, Units};

/// The state that is active between two blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// Position in program coordinates and the active units.
    pub position: Position,
    /// Bit mask of the axes whose position is known only at the machine.
    pub unknown: u8,
    /// The axes of `unknown` whose machine position the program contains.
    pub said: u8,
    /// The active units.
    pub units: Units,
    /// The plane of arcs.
    pub plane: Plane,
    /// Whether axis words are absolute positions.
    pub absolute: bool,
    /// The feed mode.
    pub feed_mode: FeedMode,
    /// The feed in the unit of the feed mode; 0 if it is unknown.
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
    /// Whether the active motion is a rapid.
    pub is_rapid: bool,
    /// Whether the active motion is a straight cut.
    pub is_line: bool,
    /// Whether a canned cycle is active.
    pub has_cycle: bool,
    /// The number of the work offset.
    pub work: usize,
    /// Whether G52 or G92 has shifted a frame, or a frame is rotated.
    pub is_shifted: bool,
}

impl State {
    /// The state that is active now.
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
