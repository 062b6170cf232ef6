//! Settings for running a program.

use crate::control::Control;
use crate::toolpath::Units;

/// Settings for running a program.
#[derive(Clone, Copy, Debug)]
pub struct RunSettings {
    /// The control whose rules are used.
    pub control: &'static Control,
    /// Units before the first G20 or G21.
    pub units: Units,
    /// Whether blocks with a slash are skipped.
    pub block_delete: bool,
    /// The retract of G73, and the distance above the last depth where the rapid of G83 ends, in the program's units. By
    /// default, the control's values.
    pub back_off: Option<f64>,
    /// How a Fanuc reads a length without a point.
    pub unpointed: Unpointed,
    /// Whether the position of the tool is known only at the machine, at the beginning and in height after a tool change.
    /// Otherwise the position is zero.
    pub places_unknown: bool,
    /// Whether I, J and K are positions at the beginning, as after G90.1.
    pub centers_absolute: bool,
    /// Whether the control is assumed: it is not given, and the program does not indicate another one.
    pub assumed: bool,
    /// Direction in which G76 and G87 of a Fanuc leave the wall along the first axis: a machine parameter, 1 or -1.
    pub bore_shift: f64,
    /// For a lathe: whether X is a diameter; `None`: as in the control's file.
    pub by_diameter: Option<bool>,
}

/// How a Fanuc reads a length without a point. This is a setting of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Unpointed {
    /// A length without a point is an error, because the setting is unknown.
    #[default]
    Refused,
    /// The value is in whole inches or millimetres.
    Whole,
    /// The value is in least increments: 0.0001 inch, 0.001 mm or degrees.
    Increments,
}

impl RunSettings {
    /// The settings of a control at power-up.
    pub fn new(control: &'static Control) -> RunSettings {
        RunSettings {
            control,
            units: Units::Mm,
            block_delete: false,
            back_off: None,
            unpointed: Unpointed::Refused,
            places_unknown: false,
            centers_absolute: false,
            assumed: false,
            bore_shift: 1.0,
            by_diameter: None,
        }
    }
}
