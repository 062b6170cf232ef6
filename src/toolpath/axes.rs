//! Positions, and the units of lengths.

/// A position: the coordinates h v d and the rotary axes a b c. An axis that is not given keeps its last position.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Axes {
    /// Value of each axis: lengths in the job's units, angles in degrees.
    pub values: [f64; 6],
    /// Which axes are given: bit i for axis i.
    pub given: u8,
}

impl Axes {
    /// A position in which the first axes have these values and the other axes are not given.
    pub fn new(values: &[f64]) -> Axes {
        let mut axes = Axes::default();
        for (i, &value) in values.iter().take(6).enumerate() {
            axes.set(i, value);
        }
        axes
    }

    /// The value of one axis; `None` if the axis is not given.
    #[inline]
    pub fn get(&self, axis: usize) -> Option<f64> {
        (self.given & 1 << axis != 0).then(|| self.values[axis])
    }

    /// Sets the value of one axis, in the job's units or in degrees.
    #[inline]
    pub fn set(&mut self, axis: usize, value: f64) {
        self.values[axis] = value;
        self.given |= 1 << axis;
    }
}

/// Units of lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Units {
    /// Inches.
    Inch,
    /// Millimetres.
    #[default]
    Mm,
}

impl Units {
    /// Name of the unit, as in jobs and options.
    pub fn name(self) -> &'static str {
        match self {
            Units::Inch => "inch",
            Units::Mm => "mm",
        }
    }

    /// Length of one unit in millimetres.
    pub fn in_mm(self) -> f64 {
        match self {
            Units::Inch => 25.4,
            Units::Mm => 1.0,
        }
    }
}
