//! State of a control's canned cycles.

use super::action::Drilling;
use super::call::Pattern;
use super::codes::Motion;
use crate::toolpath::{Plane, Units};

/// The cycle in force and its holes.
#[derive(Clone, Debug, Default)]
pub struct Holes {
    /// The cycle in force on a Fanuc. On other controls the cycle is the modal motion.
    pub cycle: Motion,
    /// Values that are kept from one hole to the next.
    pub series: Series,
    /// Remaining work of the block's cycle.
    pub work: Option<Work>,
    /// Remaining holes of the block, each made by a call.
    pub pattern: Option<Box<Pattern>>,
}

/// Values that a control keeps from one hole to the next.
#[derive(Clone, Copy, Debug, Default)]
pub struct Series {
    /// Whether a series of holes is running.
    pub running: bool,
    /// Height of the tool at the beginning of the series.
    pub initial: f64,
    /// Whether the height at the beginning is known only at the machine.
    pub initial_unknown: bool,
    /// Whether R is an increment from an unknown height.
    pub r_unknown: bool,
    /// Whether the depth is an increment from an unknown height.
    pub depth_unknown: bool,
    /// The R plane, as written.
    pub r: Option<f64>,
    /// The depth, as written.
    pub depth: Option<f64>,
    /// The dwell in seconds.
    pub dwell: Option<f64>,
    /// Depth of a peck.
    pub peck: Option<f64>,
    /// I, J and K of boring cycles.
    pub shift: [Option<f64>; 3],
    /// The distance mode (`true`: G91), plane and units in force when R and depth were written.
    pub written: Option<(bool, Plane, Units)>,
}

impl Series {
    /// Ends the series: the block has a motion that is not a cycle.
    pub fn end(&mut self) {
        self.running = false;
    }
}

/// The holes of one block that remain to be made.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    /// The current or last hole.
    pub hole: Drilling,
    /// Number of holes to make.
    pub times: u32,
    /// Number of holes begun.
    pub begun: u32,
    /// Height of the tool before the first hole.
    pub level: f64,
    /// Depth at which the next peck of the hole ends.
    pub depth: Option<f64>,
}
