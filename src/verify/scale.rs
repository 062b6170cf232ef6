//! How the numbers of a program become the job's: units, renamed axes, surface speeds.

use super::cut::Place;
use crate::nc::Position;
use crate::toolpath::Units;

/// How the numbers of the program become the job's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Units that the program counts in.
    pub units: Units,
    /// Units that places are wanted in.
    pub wanted: Units,
    /// The axes as the form prints them: the job's first is the program's so-and-so-many-th.
    pub axes: [u8; 6],
    /// There is no Y.
    pub lathe: bool,
}

impl Scale {
    pub fn factor(self) -> f64 {
        match (self.units, self.wanted) {
            (Units::Inch, Units::Mm) => 25.4,
            (Units::Mm, Units::Inch) => 1.0 / 25.4,
            _ => 1.0,
        }
    }

    /// Surface speeds are feet or metres a minute.
    pub fn surface(self) -> f64 {
        match (self.units, self.wanted) {
            (Units::Inch, Units::Mm) => 0.3048,
            (Units::Mm, Units::Inch) => 1.0 / 0.3048,
            _ => 1.0,
        }
    }

    pub fn place(self, to: &Position) -> Place {
        let factor = self.factor();
        let mut place = self.axes.map(|axis| to[usize::from(axis)]);
        place[..3].iter_mut().for_each(|value| *value *= factor);
        place
    }

    pub fn axes(self, bits: u8) -> u8 {
        if bits == 0 {
            return 0;
        }
        let bits = if self.lathe { bits & !0b010 } else { bits };
        (0..6).filter(|&axis| bits & 1 << self.axes[axis] != 0).map(|axis| 1 << axis).sum()
    }
}
