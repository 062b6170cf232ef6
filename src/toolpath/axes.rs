//! Positions, and the unit of their lengths.

/// Coordinates h v d and rotary a b c. Axes that are not given keep the tool's last position.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Axes {
    /// Value of each axis: lengths in the job's units, angles in degrees.
    pub values: [f64; 6],
    /// Bit i: axis i is given.
    pub given: u8,
}

impl Axes {
    /// The first axes, all given.
    pub fn new(values: &[f64]) -> Axes {
        let mut axes = Axes::default();
        for (i, &value) in values.iter().take(6).enumerate() {
            axes.set(i, value);
        }
        axes
    }

    /// Value of one axis, if given.
    #[inline]
    pub fn get(&self, axis: usize) -> Option<f64> {
        (self.given & 1 << axis != 0).then(|| self.values[axis])
    }

    /// Sets the value of one axis, in the job's units or degrees.
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
