//! An axis: its travel, its speed and its rotation.

/// An axis of the machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// The travel of the axis in machine coordinates, in millimetres or degrees. `None`: the machine file does not give
    /// the travel.
    pub travel: Option<Travel>,
    /// Speed of rapids, in millimetres or degrees per minute.
    pub rapid: Option<f64>,
    /// Highest feed, in millimetres or degrees per minute.
    pub feed: Option<f64>,
    /// Acceleration, in millimetres or degrees per second squared.
    pub acceleration: Option<f64>,
    /// For a rotary axis, the part of the machine that the axis turns.
    pub kind: Option<Kind>,
    /// For a rotary axis, the direction of the axis of rotation.
    pub about: Option<[f64; 3]>,
    /// Whether words of the axis are angles of the table and not of the tool. Angles of the table are negated.
    pub counts_table: bool,
}

/// The travel of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Travel {
    /// Between a least and a greatest position.
    Between(f64, f64),
    /// Rotation without limits.
    Endless,
}

impl Axis {
    /// Least and greatest position, if the travel is limited.
    pub fn limits(&self) -> Option<[f64; 2]> {
        match self.travel? {
            Travel::Between(least, greatest) => Some([least, greatest]),
            Travel::Endless => None,
        }
    }
}

/// The part of the machine that a rotary axis turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The axis turns the part, on a table.
    Table,
    /// The axis turns the spindle, in a head.
    Head,
}
