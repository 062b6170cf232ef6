//! Known angles of the rotary axes. At the start, all angles are 0.

use crate::lang::VarId;
use crate::render::shape::ROTARY;
use crate::toolpath::Axes;

/// Known angles of the rotary axes.
#[derive(Clone, Debug)]
pub struct Angles {
    /// Angle of each axis, used when the tool's position does not contain the angle.
    stands: [Option<f64>; 3],
    /// Target angle of each axis, for `[rotangle]`.
    now: [Option<f64>; 3],
    /// Previous angle of each axis, for `[lastrotangle]`.
    last: [Option<f64>; 3],
    /// Whole turns that Unwind removed from each axis, in degrees.
    wound: [f64; 3],
}

impl Default for Angles {
    fn default() -> Self {
        let zero = [Some(0.0); 3];
        Angles { stands: zero, now: zero, last: zero, wound: [0.0; 3] }
    }
}

impl Angles {
    /// Discards the known angles. The turns that Unwind removed are kept.
    pub fn forget(&mut self) {
        (self.stands, self.now, self.last) = ([None; 3], [None; 3], [None; 3]);
    }

    /// Saves the angles in the tool's position before the position is discarded.
    pub fn keep(&mut self, position: &Axes) {
        for (stands, axis) in self.stands.iter_mut().zip(ROTARY) {
            *stands = position.get(axis).or(*stands);
        }
    }

    /// Whether any angle is known. In a subprogram: whether the subprogram printed an angle.
    pub fn is_known(&self) -> bool {
        self.now.iter().any(Option::is_some)
    }

    /// Whether Unwind has removed turns from any axis.
    pub fn is_wound(&self) -> bool {
        self.wound != [0.0; 3]
    }

    /// Whether the turns that Unwind removed are equal in both states.
    pub fn wound_as(&self, other: &Angles) -> bool {
        self.wound == other.wound
    }

    /// The turns that Unwind removed from an axis, in degrees.
    pub fn wound(&self, axis: usize) -> f64 {
        self.wound[axis - ROTARY.start]
    }

    /// Removes further turns from an axis.
    pub fn wind(&mut self, axis: usize, degrees: f64) {
        self.wound[axis - ROTARY.start] += degrees;
    }

    /// Angle of an axis, if the tool's position does not contain it.
    pub fn stands(&self, axis: usize) -> Option<f64> {
        self.stands[axis - ROTARY.start]
    }

    /// Records that an axis moves from one angle to another.
    pub fn turn(&mut self, axis: usize, from: Option<f64>, to: f64) {
        self.last[axis - ROTARY.start] = from;
        self.now[axis - ROTARY.start] = Some(to);
    }

    /// Sets the previous angle of an axis.
    pub fn was(&mut self, axis: usize, angle: Option<f64>) {
        self.last[axis - ROTARY.start] = angle;
    }

    /// The value that an axis prints for `[rotangle]` or `[lastrotangle]`.
    pub fn printed(&self, var: VarId, axis: usize) -> Option<f64> {
        let angles = if var == VarId::Rotangle { &self.now } else { &self.last };
        angles[axis - ROTARY.start]
    }
}
