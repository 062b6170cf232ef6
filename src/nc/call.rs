//! Holes of cycles whose calls give all their levels: what a call is worked out from, and the steps that come of it.

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
    /// A feed to a height: the height, the feed in the feed mode's unit.
    Feed(f64, f64),
    /// A dwell in seconds.
    Dwell(f64),
    /// The spindle turns so, at this speed.
    Turn(Rotation, f64),
    /// The spindle stops at an angle.
    Orient(f64),
    /// A rapid by so much in the plane and along its axis.
    Aside([f64; 3]),
    /// A rapid to the upper end of the axis, which only the machine knows.
    Top,
    /// The program stops.
    Stop,
}

/// A hole with all that is done in it, from over the hole at any height.
#[derive(Clone, Debug, PartialEq)]
pub struct Canned {
    /// The hole; its place is that of the tool.
    pub hole: Drilling,
    /// What is done, in order.
    pub steps: Vec<Step>,
}

/// What of the control a hole depends on.
#[derive(Clone, Copy, Debug)]
pub struct Stand {
    /// Where the tool is.
    pub at: Position,
    /// The plane across the hole.
    pub plane: Plane,
    /// The units of the program.
    pub units: Units,
    /// The feed in force, in the feed mode's unit; 0 where none is known.
    pub feed: f64,
    /// Feeds count a turn.
    pub per_turn: bool,
    /// The speed in force.
    pub speed: f64,
    /// How the spindle turns.
    pub turning: Rotation,
    /// How far a peck's rapid stays above the last depth, where the cycle does not say.
    pub back_off: f64,
    /// Which way a bore leaves the wall along the first axis, 1 or -1.
    pub bore_shift: f64,
}

/// A cycle as a block calls it, with its words as they are written.
pub trait Plan: Debug + Send + Sync {
    /// Works the hole out; `None`: it does nothing.
    ///
    /// # Errors
    /// What the cycle refuses, or what no text says for certain.
    fn plan(&self, stand: &Stand) -> Done<Option<Canned>>;
}

/// A cycle that may be called more than once.
pub type Call = Arc<dyn Plan>;

/// Holes of one cycle that are still to be made, by their positions in the plane.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// The cycle.
    pub call: Call,
    /// Where its holes are.
    pub at: VecDeque<[f64; 2]>,
}
