//! Converts the numbers of a program to the units and axes of its job, and converts surface speeds.

use super::cut::{Place, UNSAID, place, position};
use crate::nc::{Cutter, Position};
use crate::toolpath::Units;

/// The axes if the form renames none.
const AS_WRITTEN: [u8; 6] = [0, 1, 2, 3, 4, 5];

/// Conversion of the program's numbers to the job's units and axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Units of the program.
    pub units: Units,
    /// Units of the job, in which positions are compared.
    pub wanted: Units,
    /// For each axis of the job, the axis in the program, because a form may rename axes.
    pub axes: [u8; 6],
    /// Whether the machine is a lathe, which has no Y.
    pub lathe: bool,
    /// Whether the form prints no depth axis.
    pub flat: bool,
    /// On a wire EDM machine the third and fourth axes are U and V. Each bit marks one of these axes that has no value.
    pub wire: Option<u8>,
}

impl Scale {
    #[inline]
    pub fn factor(self) -> f64 {
        match (self.units, self.wanted) {
            (Units::Inch, Units::Mm) => 25.4,
            (Units::Mm, Units::Inch) => 1.0 / 25.4,
            _ => 1.0,
        }
    }

    /// The factor for surface speeds, which are in feet or metres per minute.
    pub fn surface(self) -> f64 {
        match (self.units, self.wanted) {
            (Units::Inch, Units::Mm) => 0.3048,
            (Units::Mm, Units::Inch) => 1.0 / 0.3048,
            _ => 1.0,
        }
    }

    /// The diameter and the orientation of a compensated tool that the program gives.
    pub fn cutter(self, cutter: Cutter) -> Option<[f64; 2]> {
        let Cutter::Given { diameter, orientation } = cutter else { return None };
        Some([diameter * self.factor(), orientation])
    }

    #[inline]
    pub fn place(&self, to: &Position) -> Place {
        let factor = self.factor();
        if factor == 1.0 && self.axes == AS_WRITTEN && self.wire.is_none() && !self.flat {
            return place(to);
        }
        if let Some(unsaid) = self.wire {
            let [x, y, u, v, ..] = *to;
            let guide = |axis: u8, value: f64| if unsaid & 1 << axis == 0 { value * factor } else { UNSAID };
            return [x * factor, y * factor, 0.0, 0.0, 0.0, 0.0, guide(2, u), guide(3, v)];
        }
        let mut at = self.axes.map(|axis| to[usize::from(axis)]);
        at[..3].iter_mut().for_each(|value| *value *= factor);
        if self.flat {
            at[2] = 0.0;
        }
        place(&at)
    }

    /// The end of an arc. If the upper wire guide moves too, the other two values are the position of this guide.
    pub fn end_of_arc(self, to: &Position) -> Position {
        let end = self.place(to);
        let mut at = position(&end);
        for (axis, guide) in [(2, end[6]), (3, end[7])] {
            if guide != UNSAID {
                at[axis] = guide;
            }
        }
        at
    }

    /// The axes whose positions are unknown, as bits. If the form prints no depth axis, the depth is always unknown.
    pub fn unknown(self, bits: u8) -> u8 {
        self.axes(bits) | u8::from(self.flat) << 2
    }

    pub fn axes(self, bits: u8) -> u8 {
        let bits = if self.flat { bits & !0b100 } else { bits };
        if bits == 0 {
            return 0;
        }
        if self.wire.is_some() {
            return bits & 0b11;
        }
        let bits = if self.lathe { bits & !0b010 } else { bits };
        (0..6).filter(|&axis| bits & 1 << self.axes[axis] != 0).map(|axis| 1 << axis).sum()
    }
}
