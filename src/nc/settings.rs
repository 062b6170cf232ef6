//! The settings for running a program.

use crate::control::Control;
use crate::toolpath::Units;

/// The settings for running a program.
#[derive(Clone, Copy, Debug)]
pub struct RunSettings {
    /// The control by whose rules the program is run.
    pub control: &'static Control,
    /// The units that are active before the first G20 or G21.
    pub units: Units,
    /// Whether blocks with a slash are skipped.
    pub block_delete: bool,
    /// The retract of G73, and the distance above the last depth at which the rapid of G83 ends, in the program's
    /// units. `None`: the values of the control.
    pub back_off: Option<f64>,
    /// The meaning of a length without a decimal point, on a Fanuc.
    pub unpointed: Unpointed,
    /// Whether feeds without a decimal point are in whole units: the form prints all feeds without one, for a machine that
    /// reads them so.
    pub whole_feeds: bool,
    /// Whether two positions count as unknown: the position of the tool at the beginning, and its height after a tool
    /// change. If `false`, the position is zero.
    pub places_unknown: bool,
    /// Whether I, J and K are absolute positions at the beginning, as after G90.1.
    pub centers_absolute: bool,
    /// Whether the control is an assumption: the user did not name a control, and the program does not indicate one.
    pub assumed: bool,
    /// The direction along the first axis in which G76 and G87 of a Fanuc move away from the wall: 1 or -1. A machine
    /// parameter sets this direction.
    pub bore_shift: f64,
    /// On a lathe, whether X is a diameter; `None`: as in the control's file.
    pub by_diameter: Option<bool>,
}

/// The meaning of a length without a decimal point on a Fanuc. This meaning depends on a setting of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Unpointed {
    /// A length without a decimal point is an error, because the setting is unknown.
    #[default]
    Refused,
    /// The value is in whole inches or millimetres.
    Whole,
    /// The value is in least increments: 0.0001 inch, 0.001 mm or degrees.
    Increments,
}

impl RunSettings {
    /// The retract of G73, and the distance above the last depth at which the rapid of G83 ends, in these units.
    pub fn back_off_in(&self, units: Units) -> f64 {
        self.back_off.unwrap_or(match (self.control.is_linuxcnc(), units) {
            (false, Units::Inch) => 0.02,
            (false, Units::Mm) => 0.5,
            (true, Units::Inch) => 0.010,
            (true, Units::Mm) => 0.254,
        })
    }

    /// The settings of a control at power-up.
    pub fn new(control: &'static Control) -> RunSettings {
        RunSettings {
            control,
            units: Units::Mm,
            block_delete: false,
            back_off: None,
            unpointed: Unpointed::Refused,
            whole_feeds: false,
            places_unknown: false,
            centers_absolute: false,
            assumed: false,
            bore_shift: 1.0,
            by_diameter: None,
        }
    }
}
