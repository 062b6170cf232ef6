//! The zero from which a program measures its positions: the work offset, with the shifts of G52 and G92.

use super::Program;
use crate::verify::cut::Place;

/// The zero of a program. A work offset that the program does not set is at the machine's zero.
pub(in crate::verify) struct Zero {
    /// Machine position of the zero.
    pub at: Place,
    /// Rotation about the zero, in degrees.
    pub angle: f64,
    /// As bits, the axes for which the program has set the work offset to a machine position.
    pub set: u8,
    /// As bits, the axes that were shifted from an unknown machine position.
    pub unknown: u8,
}

impl Program<'_> {
    /// The active zero.
    pub fn zero(&self) -> Zero {
        let state = self.simulator.state();
        let (at, angle) = state.zero();
        Zero { at: self.scale.place(&at), angle, set: state.offset_given(), unknown: state.frame_unknown() }
    }
}
