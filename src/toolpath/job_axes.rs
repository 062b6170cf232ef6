//! What the numbers of a position mean on each type of machine.

use crate::lang::Machine;

/// The axes of the positions of a job. An axis is an index into [`Axes`](super::Axes), and a set of axes is its bits.
#[derive(Clone, Copy, Debug)]
pub struct JobAxes {
    /// The linear axes. The position of a tool along these axes is unknown after a tool change.
    pub linear: u8,
    /// The linear axes that a complete first position gives.
    pub first: u8,
    /// The axis along which the tool enters a hole; `None`: the machine makes no holes.
    pub depth: Option<usize>,
    /// The letters of the axes, for messages.
    pub names: [char; 6],
}

impl JobAxes {
    /// The axes of a type of machine.
    pub const fn of(machine: Machine) -> JobAxes {
        match machine {
            Machine::Mill => {
                JobAxes { linear: 0b111, first: 0b111, depth: Some(2), names: ['X', 'Y', 'Z', 'A', 'B', 'C'] }
            }
            Machine::Lathe => {
                JobAxes { linear: 0b111, first: 0b011, depth: Some(0), names: ['Z', 'X', 'Y', 'A', 'B', 'C'] }
            }
            // the lower and the upper guide of the wire
            Machine::Edm => {
                JobAxes { linear: 0b1111, first: 0b011, depth: None, names: ['X', 'Y', 'U', 'V', 'A', 'B'] }
            }
        }
    }

    /// The axis along which the tool enters a hole, as a bit; 0: the machine makes no holes.
    pub const fn depth_bit(self) -> u8 {
        match self.depth {
            Some(axis) => 1 << axis,
            None => 0,
        }
    }
}
