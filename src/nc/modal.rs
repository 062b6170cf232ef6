//! The modal state between two blocks, as the codes and values that the screen of a control shows.

use super::action::Rotation;
use super::state::State;
use crate::control::{Code, Meaning};
use crate::toolpath::{FeedMode, Plane, Side, Units};

/// The modal state of the control between two blocks. A field of type `u16` contains the number of the usual code,
/// times ten.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modal {
    /// The active motion: G0 to G3 or another code of their group. The field `cycle` contains canned cycles.
    pub motion: Option<Code>,
    /// G17 to G19.
    pub plane: u16,
    /// G90 or G91.
    pub distance: u16,
    /// G20 or G21.
    pub units: u16,
    /// G93, G94 or G95.
    pub feed_mode: u16,
    /// G98 or G99.
    pub back: u16,
    /// G40 to G42.
    pub compensation: u16,
    /// Whether a tool length offset is on.
    pub length: bool,
    /// The active canned cycle.
    pub cycle: Option<Code>,
    /// The register of cutter compensation.
    pub diameter: Option<f64>,
    /// The F value in the unit of the feed mode; 0 if the program has set no F.
    pub feed: f64,
    /// The S value.
    pub speed: f64,
    /// Rotation of the spindle.
    pub spindle: Rotation,
}

impl State {
    /// The modal state after the last block.
    pub fn modal(&self) -> Modal {
        Modal {
            motion: self.modes.motion.filter(|row| row.meaning != Meaning::Cycle).map(|row| row.code),
            plane: match self.modes.plane {
                Plane::Xy => 170,
                Plane::Xz => 180,
                Plane::Yz => 190,
            },
            distance: if self.modes.absolute { 900 } else { 910 },
            units: if self.modes.units == Units::Inch { 200 } else { 210 },
            feed_mode: match self.modes.feed_mode {
                FeedMode::InverseTime => 930,
                FeedMode::PerMinute => 940,
                FeedMode::PerRev => 950,
            },
            back: if self.modes.to_initial { 980 } else { 990 },
            compensation: match self.tool.side {
                None => 400,
                Some(Side::Left) => 410,
                Some(Side::Right) => 420,
            },
            length: self.tool.length_on,
            cycle: self.cycle_in_force().map(|row| row.code),
            diameter: self.tool.diameter_register,
            feed: self.drive.feed,
            speed: self.drive.speed,
            spindle: self.drive.spindle,
        }
    }
}
