//! State of the machine after a block.

use crate::nc::state::State;

/// State of the machine after a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Behind {
    /// Axes that are at a machine position, as bits.
    pub unknown: u8,
    /// The shift that G52 and G92 add to positions.
    pub shift: [f64; 3],
    /// Axes whose frame G92 moved from a position that was known only at the machine, as bits.
    pub frame: u8,
}

impl Behind {
    pub fn of(state: &State) -> Behind {
        let [x, y, z, ..] = *state.shift();
        Behind { unknown: state.at_machine(), shift: [x, y, z], frame: state.frame_unknown() }
    }
}
