//! What an operation works with: tool, spindle, coolant, and what its feeds count.

pub use crate::lang::Coolant;

use super::start::Given;

/// A tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tool {
    /// Number by which the program calls the tool.
    pub number: f64,
    /// Diameter, in the job's units.
    pub diameter: Option<f64>,
    /// Radius of the corner, in the job's units.
    pub corner_radius: Option<f64>,
    /// Register of the tool's length.
    pub length_offset: Option<f64>,
    /// Register of the tool's diameter, for cutter compensation.
    pub diameter_offset: Option<f64>,
    /// Place in the turret, where that is not the number.
    pub turret: Option<f64>,
    /// Name of the tool.
    pub name: Option<String>,
    /// What the program says of the tool.
    pub comment: Option<String>,
    /// What else is known of it, as a holder or its stick-out, by names of the job's own.
    pub data: Vec<(String, Given)>,
}

/// Which way the spindle turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpindleTurn {
    /// Clockwise, seen from the spindle: M3.
    Cw,
    /// Counterclockwise: M4.
    Ccw,
    /// The spindle stands: M5.
    Off,
}

/// The spindle; what is not given stays.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Spindle {
    /// Revolutions a minute; at constant surface speed what the control counts there.
    pub speed: Option<f64>,
    /// Direction of the spindle.
    pub turn: Option<SpindleTurn>,
    /// Does the speed count at the surface of the part?
    pub css: Option<bool>,
    /// Highest revolutions a minute at constant surface speed.
    pub max: Option<f64>,
}

/// What a feed counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// Length a minute: G94, on lathes G98.
    PerMinute,
    /// Length a turn of the spindle: G95, on lathes G99.
    PerRev,
    /// Moves a minute: G93.
    InverseTime,
}
