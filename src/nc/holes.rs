//! The state of a control's canned cycles.

use super::action::Drilling;
use super::call::Pattern;
use super::codes::Motion;
use crate::toolpath::{Plane, Units};

/// The active cycle and its holes.
#[derive(Clone, Debug, Default)]
pub struct Holes {
    /// The active cycle on a Fanuc. On other controls the cycle is the modal motion.
    pub cycle: Motion,
    /// Values that are kept for the next hole.
    pub series: Series,
    /// The number of holes that were made by the last blocks one after the other, each block with only a position in
    /// the plane of the cycle. Counted by `ahead.rs`.
    pub alike: u8,
    /// The part of the block's cycle that has not been run yet.
    pub work: Option<Work>,
    /// The holes of the block that are not made yet. Each of these holes is made by a call of a cycle.
    pub pattern: Option<Box<Pattern>>,
}

/// Values that a control keeps for the next hole.
#[derive(Clone, Copy, Debug, Default)]
pub struct Series {
    /// Whether a series of holes is running.
    pub running: bool,
    /// Height of the tool at the beginning of the series, which is the initial level.
    pub initial: f64,
    /// Whether the initial level is known only at the machine.
    pub initial_unknown: bool,
    /// Whether the initial level is a height in another work offset than the active one.
    pub initial_elsewhere: bool,
    /// Whether R is an increment from an unknown height.
    pub r_unknown: bool,
    /// Whether the depth is an increment from an unknown height.
    pub depth_unknown: bool,
    /// R as written.
    pub r: Option<f64>,
    /// The depth as written.
    pub depth: Option<f64>,
    /// The dwell in seconds.
    pub dwell: Option<f64>,
    /// Depth of a peck.
    pub peck: Option<f64>,
    /// The spindle speed of a tap on its way out.
    pub speed_out: Option<f64>,
    /// I, J and K of boring cycles.
    pub shift: [Option<f64>; 3],
    /// The distance mode (`true`: G91), the plane and the units that were active when R and the depth were written.
    pub written: Option<(bool, Plane, Units)>,
}

impl Series {
    /// Ends the series. Call this function for a block with a motion that is not a cycle.
    pub fn end(&mut self) {
        self.running = false;
    }
}

/// The state of a block whose holes are being made.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    /// The current hole, or the last one.
    pub hole: Drilling,
    /// Number of holes to make.
    pub times: u32,
    /// Number of holes begun.
    pub begun: u32,
    /// Height of the tool before the first hole.
    pub level: f64,
    /// If the hole is not finished: the depth at which its next peck ends.
    pub depth: Option<f64>,
}
