//! What is known of the rotary axes; a machine begins with all of them at 0.

use crate::lang::VarId;
use crate::render::shape::ROTARY;
use crate::toolpath::Axes;

/// What is known of the rotary axes.
#[derive(Clone, Debug)]
pub struct Angles {
    /// Where each rotary axis stands while the tool's position does not say it.
    stands: [Option<f64>; 3],
    /// Where each goes, for `[rotangle]`.
    now: [Option<f64>; 3],
    /// Where each was before, for `[lastrotangle]`.
    last: [Option<f64>; 3],
    /// Whole turns that Unwind took off each, in degrees.
    wound: [f64; 3],
}

impl Default for Angles {
    fn default() -> Self {
        let zero = [Some(0.0); 3];
        Angles { stands: zero, now: zero, last: zero, wound: [0.0; 3] }
    }
}

impl Angles {
    /// Forgets where the axes stand. Turns that were taken off stay off.
    pub fn forget(&mut self) {
        (self.stands, self.now, self.last) = ([None; 3], [None; 3], [None; 3]);
    }

    /// Keeps the angles that the tool's position says, before the position is forgotten.
    pub fn keep(&mut self, position: &Axes) {
        for (stands, axis) in self.stands.iter_mut().zip(ROTARY) {
            *stands = position.get(axis).or(*stands);
        }
    }

    /// Is any angle known? In a subprogram: one that it said.
    pub fn is_known(&self) -> bool {
        self.now.iter().any(Option::is_some)
    }

    /// Have turns been taken off?
    pub fn is_wound(&self) -> bool {
        self.wound != [0.0; 3]
    }

    /// Have the same turns been taken off?
    pub fn wound_as(&self, other: &Angles) -> bool {
        self.wound == other.wound
    }

    /// The turns that were taken off an axis, in degrees.
    pub fn wound(&self, axis: usize) -> f64 {
        self.wound[axis - ROTARY.start]
    }

    /// Further turns come off an axis.
    pub fn wind(&mut self, axis: usize, degrees: f64) {
        self.wound[axis - ROTARY.start] += degrees;
    }

    /// Where an axis stands while the tool's position does not say it.
    pub fn stands(&self, axis: usize) -> Option<f64> {
        self.stands[axis - ROTARY.start]
    }

    /// An axis goes from one angle to another.
    pub fn turn(&mut self, axis: usize, from: Option<f64>, to: f64) {
        self.last[axis - ROTARY.start] = from;
        self.now[axis - ROTARY.start] = Some(to);
    }

    /// Where an axis was.
    pub fn was(&mut self, axis: usize, angle: Option<f64>) {
        self.last[axis - ROTARY.start] = angle;
    }

    /// What an axis prints for `[rotangle]` and `[lastrotangle]`.
    pub fn printed(&self, var: VarId, axis: usize) -> Option<f64> {
        let angles = if var == VarId::Rotangle { &self.now } else { &self.last };
        angles[axis - ROTARY.start]
    }
}
