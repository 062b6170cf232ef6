//! The data of an operation: tool, spindle, coolant and feed mode.

pub use crate::lang::Coolant;

use super::axes::Units;
use super::start::Given;

/// A tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tool {
    /// Number with which the program calls the tool.
    pub number: f64,
    /// Diameter, in the job's units.
    pub diameter: Option<f64>,
    /// Radius of the corner, in the job's units.
    pub corner_radius: Option<f64>,
    /// Number of the register that holds the tool's length.
    pub length_offset: Option<f64>,
    /// Number of the register that holds the tool's diameter, for cutter compensation.
    pub diameter_offset: Option<f64>,
    /// Position of the tool in the turret, if it differs from the tool number.
    pub turret: Option<f64>,
    /// Name of the tool.
    pub name: Option<String>,
    /// Comment about the tool that the program prints.
    pub comment: Option<String>,
    /// Other data of the tool, such as the holder or the stick-out, each with a name that the job chooses.
    pub data: Vec<(String, Given)>,
}

/// Rotation of the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpindleTurn {
    /// Clockwise, seen from the spindle: M3.
    Cw,
    /// Counterclockwise: M4.
    Ccw,
    /// Stopped: M5.
    Off,
}

/// Spindle data. A value that the job does not give stays unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Spindle {
    /// Speed in revolutions per minute, or surface speed in the unit of the control.
    pub speed: Option<f64>,
    /// Direction of the spindle.
    pub turn: Option<SpindleTurn>,
    /// Whether the speed is a constant surface speed.
    pub css: Option<bool>,
    /// Highest speed in revolutions per minute while a constant surface speed is active.
    pub max: Option<f64>,
}

impl Spindle {
    /// The state after this change; values that are missing are taken from the state before.
    pub(crate) fn after(self, before: Spindle) -> Spindle {
        Spindle {
            speed: self.speed.or(before.speed),
            turn: self.turn.or(before.turn),
            css: self.css.or(before.css),
            max: self.max.or(before.max),
        }
    }

    /// The spindle data at the beginning of an operation: a speed without a mode is in revolutions per minute, also after an
    /// operation with surface speed.
    pub(crate) fn of_operation(self) -> Spindle {
        Spindle { css: self.css.or(self.speed.map(|_| false)), ..self }
    }

    /// Revolutions per minute with the tool at this distance from the axis, if known. At a constant surface speed, which
    /// is in feet per minute with inches and in metres per minute with millimetres, they depend on the distance.
    pub(crate) fn rpm(&self, radius: Option<f64>, units: Units) -> Option<f64> {
        let speed = self.speed?;
        if self.css != Some(true) {
            return Some(speed);
        }
        let surface = match units {
            Units::Inch => 12.0,
            Units::Mm => 1000.0,
        };
        let rpm = speed * surface / (std::f64::consts::TAU * radius?);
        Some(rpm.min(self.max.unwrap_or(f64::INFINITY))).filter(|rpm| rpm.is_finite())
    }
}

/// The unit of feeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// Length per minute: G94, on lathes G98.
    PerMinute,
    /// Length per turn of the spindle: G95, on lathes G99.
    PerRev,
    /// Moves per minute: the inverse of the time of a move. G93.
    InverseTime,
}

impl FeedMode {
    /// The time in minutes of a cut of this length, if known. `rpm`: revolutions of the spindle per minute.
    pub(crate) fn minutes(self, length: f64, feed: f64, rpm: Option<f64>) -> Option<f64> {
        let minutes = match self {
            FeedMode::InverseTime => 1.0 / feed,
            _ if length == 0.0 => 0.0,
            FeedMode::PerMinute => length / feed,
            FeedMode::PerRev => length / (feed * rpm?),
        };
        Some(minutes).filter(|minutes| minutes.is_finite())
    }
}
