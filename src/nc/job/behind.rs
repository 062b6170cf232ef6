//! How a machine stands after a block.

use crate::nc::state::State;

/// How the machine stands after a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Behind {
    /// Axes that stand at a place of the machine, as bits.
    pub unknown: u8,
    /// What G52 and G92 add to positions.
    pub shift: [f64; 3],
    /// Axes whose frame G92 moved from a position that only the machine knew, as bits.
    pub frame: u8,
}

impl Behind {
    pub fn of(state: &State) -> Behind {
        let [x, y, z, ..] = *state.shift();
        Behind { unknown: state.at_machine(), shift: [x, y, z], frame: state.frame_unknown() }
    }
}
