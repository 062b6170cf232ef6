//! What a control keeps for canned cycles.

use super::action::Drilling;
use super::call::Pattern;
use super::codes::Motion;
use crate::toolpath::{Plane, Units};

/// The cycle in force and its holes.
#[derive(Clone, Debug, Default)]
pub struct Holes {
    /// The cycle in force on a Fanuc; elsewhere it is the modal motion.
    pub cycle: Motion,
    /// What is kept from one hole to the next.
    pub series: Series,
    /// What the block's cycle still has to make.
    pub work: Option<Work>,
    /// Holes that the block still has to make, each by a call.
    pub pattern: Option<Box<Pattern>>,
}

/// What a control keeps from one hole to the next.
#[derive(Clone, Copy, Debug, Default)]
pub struct Series {
    /// A series of cycles is running.
    pub running: bool,
    /// Height of the tool at its beginning.
    pub initial: f64,
    /// Only the machine knows the height at its beginning.
    pub initial_unknown: bool,
    /// R counts from there.
    pub r_unknown: bool,
    /// The depth counts from there.
    pub depth_unknown: bool,
    /// The R plane, as written.
    pub r: Option<f64>,
    /// The depth, as written.
    pub depth: Option<f64>,
    /// The dwell in seconds.
    pub dwell: Option<f64>,
    /// The peck.
    pub peck: Option<f64>,
    /// I, J and K of boring cycles.
    pub shift: [Option<f64>; 3],
    /// The mode (G91: true), plane and units in which R and depth were written.
    pub written: Option<(bool, Plane, Units)>,
}

impl Series {
    /// A motion that is no cycle ends it.
    pub fn end(&mut self) {
        self.running = false;
    }
}

/// Holes of one block that are still to be made.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    /// The hole that is made, or was made last.
    pub hole: Drilling,
    /// How many are to be made.
    pub times: u32,
    /// How many were begun.
    pub begun: u32,
    /// Height of the tool before the first.
    pub level: f64,
    /// Where the next peck of the hole ends.
    pub depth: Option<f64>,
}
