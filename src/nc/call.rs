//! Holes of cycles whose calls contain all their levels: the input of a call, and the resulting steps.

use std::collections::VecDeque;
use std::fmt::Debug;
use std::sync::Arc;

use super::action::{Drilling, Position, Rotation};
use super::fault::Done;
use crate::toolpath::{Plane, Units};

/// One step of a hole. Heights are positions of the axis across the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A rapid to a height.
    Rapid(f64),
    /// A feed move to a height: the height, and the feed in the unit of the feed mode.
    Feed(f64, f64),
    /// A dwell in seconds.
    Dwell(f64),
    /// The spindle turns in this direction at this speed.
    Turn(Rotation, f64),
    /// The spindle stops at an angle.
    Orient(f64),
    /// A rapid by this distance in the plane and along its axis.
    Aside([f64; 3]),
    /// A rapid to the upper end of the axis, whose height is known only at the machine.
    Top,
    /// The program stops.
    Stop,
}

/// A hole with all its steps. The first step may begin at any height above the hole.
#[derive(Clone, Debug, PartialEq)]
pub struct Canned {
    /// The hole, at the position of the tool.
    pub hole: Drilling,
    /// The steps in order.
    pub steps: Vec<Step>,
}

/// The state of the control that a hole depends on.
#[derive(Clone, Copy, Debug)]
pub struct Stand {
    /// Position of the tool.
    pub at: Position,
    /// The plane across the hole.
    pub plane: Plane,
    /// The units of the program.
    pub units: Units,
    /// The feed in force, in the unit of the feed mode; 0 if none is known.
    pub feed: f64,
    /// Whether feeds are per turn of the spindle.
    pub per_turn: bool,
    /// The speed in force.
    pub speed: f64,
    /// Rotation of the spindle.
    pub turning: Rotation,
    /// The distance above the last depth at which the rapid of a peck stops, if the cycle has no such word.
    pub back_off: f64,
    /// The direction along the first axis in which a bore leaves the wall: 1 or -1.
    pub bore_shift: f64,
}

/// A cycle call of a block, with its words as written.
pub trait Plan: Debug + Send + Sync {
    /// Works out the hole; `None`: the call makes no hole.
    ///
    /// # Errors
    /// The cycle refuses its words, or the documentation leaves the result open.
    fn plan(&self, stand: &Stand) -> Done<Option<Canned>>;
}

/// A cycle that may be called more than once.
pub type Call = Arc<dyn Plan>;

/// The remaining holes of one cycle, by their positions in the plane.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// The cycle.
    pub call: Call,
    /// Positions of the holes.
    pub at: VecDeque<[f64; 2]>,
}
