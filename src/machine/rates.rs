//! The speeds and accelerations of a machine, for calculating the times of programs.

use super::{LETTERS, Machine};
use crate::control::{Control, Rules};
use crate::times::{AxisRates, Corner, PathMode, Rates};

/// How far a path may deviate at a corner if the file does not contain a value, in millimetres. The value is the
/// default of Grbl's `$11`.
const DEVIATION: f64 = 0.01;
/// Number of blocks that Grbl plans ahead: the buffer of Grbl has 16 blocks, one of which stays free.
const GRBL_AHEAD: usize = 15;
/// Number of blocks that other controls plan ahead if the file does not contain a value. The value is postform's own
/// choice.
const AHEAD: usize = 200;

/// How a control moves through corners.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corners {
    /// How far the path may deviate at a corner, in millimetres.
    pub deviation: Option<f64>,
    /// Number of blocks that the control plans ahead.
    pub ahead: Option<usize>,
}

impl Machine {
    /// The speeds and accelerations of the machine.
    ///
    /// # Errors
    /// Some values are missing. The error names the missing values.
    pub fn rates(&self) -> Result<Rates, String> {
        let missing = |what: &str, of: fn(&super::Axis) -> Option<f64>| {
            let lacks = |axis: &usize| self.axes[*axis].as_ref().is_some_and(|axis| of(axis).is_none());
            let letters: Vec<String> = (0..6).filter(lacks).map(|axis| LETTERS[axis].to_string()).collect();
            (!letters.is_empty()).then(|| format!("the {what} of {}", letters.join(", ")))
        };
        let lacks = [missing("acceleration", |axis| axis.acceleration), missing("rapid", |axis| axis.rapid)];
        let lacks: Vec<String> = lacks.into_iter().flatten().collect();
        if !lacks.is_empty() {
            return Err(lacks.join(" and "));
        }
        if self.axes.iter().all(Option::is_none) {
            return Err("the accelerations of its axes".into());
        }
        let axes = std::array::from_fn(|axis| {
            let second = |minute: f64| minute / 60.0;
            self.axes[axis].as_ref().map_or_else(AxisRates::default, |axis| AxisRates {
                rapid: axis.rapid.map(second),
                feed: axis.feed.map(second),
                acceleration: axis.acceleration,
            })
        });
        let rules = self.control.map(Control::rules);
        let deviates = self.control.is_some_and(|control| control.traits().junction_deviation);
        let ahead = self.corners.ahead.unwrap_or(if rules == Some(Rules::Grbl) { GRBL_AHEAD } else { AHEAD });
        let corner = match (rules, self.corners.deviation) {
            // valid until the program sets an accuracy
            (Some(Rules::Linuxcnc | Rules::Emc2), tolerance) if !deviates => {
                Corner::Linuxcnc(PathMode::Blend(tolerance))
            }
            (_, deviation) => Corner::Deviation(deviation.unwrap_or(DEVIATION)),
        };
        Ok(Rates { axes, corner, ahead })
    }
}
