//! Cycles whose calls contain all heights. This file defines the state on which a call depends, and the steps of a hole
//! that the call makes.

use std::collections::VecDeque;
use std::fmt::Debug;
use std::sync::Arc;

use super::action::{Drilling, Position, Rotation};
use super::fault::Done;
use crate::toolpath::{Plane, Units};

/// One step of a hole. Heights are positions of the axis perpendicular to the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A rapid to a height.
    Rapid(f64),
    /// A feed move. The first number is the height, the second is the feed in the unit of the feed mode.
    Feed(f64, f64),
    /// A dwell in seconds.
    Dwell(f64),
    /// The spindle starts, with this direction and this speed.
    Turn(Rotation, f64),
    /// The spindle stops at an angle in degrees; `None`: at the control's own angle.
    Orient(Option<f64>),
    /// A rapid by these distances: along the two axes of the plane, and along the axis perpendicular to it.
    Aside([f64; 3]),
    /// A rapid to the upper limit of the axis. The height of this limit is known only at the machine.
    Top,
    /// A program stop.
    Stop,
}

/// A hole with all its steps. The tool may be at any height above the hole when the first step begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Canned {
    /// The hole, which is at the current position of the tool.
    pub hole: Drilling,
    /// The steps in order.
    pub steps: Vec<Step>,
}

/// The state of the control on which a hole depends.
#[derive(Clone, Copy, Debug)]
pub struct Stand {
    /// Position of the tool.
    pub at: Position,
    /// The plane perpendicular to the hole.
    pub plane: Plane,
    /// The units of the program.
    pub units: Units,
    /// The active feed, in the unit of the feed mode; 0 if it is unknown.
    pub feed: f64,
    /// Whether feeds are per revolution of the spindle.
    pub per_turn: bool,
    /// The active spindle speed.
    pub speed: f64,
    /// Rotation of the spindle.
    pub turning: Rotation,
    /// After a peck, the rapid into the hole stops at this distance above the depth reached so far. A cycle with its
    /// own word for this distance uses the value of this word.
    pub back_off: f64,
    /// The direction along the first axis in which a boring tool moves away from the wall: 1 or -1.
    pub bore_shift: f64,
}

/// The call of a cycle in a block, with its words as written.
pub trait Plan: Debug + Send + Sync {
    /// Calculates the hole. `None`: the call makes no hole.
    ///
    /// # Errors
    /// The cycle refuses its words, or the documentation does not define the result.
    fn plan(&self, stand: &Stand) -> Done<Option<Canned>>;
}

/// A call that may be run more than once.
pub type Call = Arc<dyn Plan>;

/// The positions at which one cycle still has to make holes.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// The cycle.
    pub call: Call,
    /// Positions of the holes in the plane.
    pub at: VecDeque<[f64; 2]>,
}
