//! An axis: its travel, its speed and its rotation.

/// An axis of the machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Its travel in machine coordinates, in millimetres or degrees. `None`: not in the file.
    pub travel: Option<Travel>,
    /// Its rapid, in millimetres or degrees per minute.
    pub rapid: Option<f64>,
    /// Its fastest feed, in millimetres or degrees per minute.
    pub feed: Option<f64>,
    /// Its acceleration, in millimetres or degrees per second squared.
    pub acceleration: Option<f64>,
    /// The kind of a rotary axis.
    pub kind: Option<Kind>,
    /// The direction of its rotation axis.
    pub about: Option<[f64; 3]>,
    /// Its words are the angle of the table, not that of the tool: they are negated.
    pub counts_table: bool,
}

/// The travel of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Travel {
    /// From a position to another.
    Between(f64, f64),
    /// Endless rotation.
    Endless,
}

impl Axis {
    /// Least and greatest position, if there are any.
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
    /// The part, on a table.
    Table,
    /// The spindle, in a head.
    Head,
}
