//! An axis: its travel, its speed, how it turns.

/// An axis of the machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// How far it goes, in machine coordinates: millimetres or degrees. `None`: the file does not give it.
    pub travel: Option<Travel>,
    /// Its rapid, in millimetres or degrees a minute.
    pub rapid: Option<f64>,
    /// Its fastest feed, in millimetres or degrees a minute.
    pub feed: Option<f64>,
    /// Its acceleration, in millimetres or degrees a second squared.
    pub acceleration: Option<f64>,
    /// How it turns, of a rotary axis.
    pub kind: Option<Kind>,
    /// The direction about which it turns.
    pub about: Option<[f64; 3]>,
    /// Its words count the turn of the table, not that of the tool: they are negated.
    pub counts_table: bool,
}

/// How far an axis goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Travel {
    /// From a position to another.
    Between(f64, f64),
    /// It turns without end.
    Endless,
}

impl Axis {
    /// Least and greatest position, where it has them.
    pub fn limits(&self) -> Option<[f64; 2]> {
        match self.travel? {
            Travel::Between(least, greatest) => Some([least, greatest]),
            Travel::Endless => None,
        }
    }
}

/// What a rotary axis turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The part, on a table.
    Table,
    /// The spindle, in a head.
    Head,
}
