//! State of the machine after a block.

use crate::nc::state::State;

/// State of the machine after a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Behind {
    /// Bit mask of the axes that are at a machine position.
    pub unknown: u8,
    /// The shift that G52 and G92 add to positions, along X, Y and Z.
    pub shift: [f64; 3],
    /// Bit mask of the axes along which G92 shifted the frame while their position was known only at the machine.
    pub frame: u8,
}

impl Behind {
    pub fn of(state: &State) -> Behind {
        let [x, y, z, ..] = *state.shift();
        Behind { unknown: state.at_machine(), shift: [x, y, z], frame: state.frame_unknown() }
    }
}
