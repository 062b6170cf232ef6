//! How a program is run.

use crate::control::Control;
use crate::toolpath::Units;

/// What is run and how.
#[derive(Clone, Copy, Debug)]
pub struct RunSettings {
    /// The control by whose rules a program is run.
    pub control: &'static Control,
    /// Units before the first G20 or G21.
    pub units: Units,
    /// Blocks with a slash are left out.
    pub block_delete: bool,
    /// How far G73 goes back, and how far above the last depth G83 ends its rapid, in the program's units; by default
    /// what the control does.
    pub back_off: Option<f64>,
    /// What a Fanuc makes of a length without a point.
    pub unpointed: Unpointed,
    /// At the beginning, and in height after a tool change, the tool is at a place that only the machine knows; else it
    /// is at zero.
    pub places_unknown: bool,
    /// I, J and K are places from the beginning, as after G90.1.
    pub centers_absolute: bool,
    /// The control is not named: the program shows no other than this one.
    pub assumed: bool,
    /// Which way G76 and G87 of a Fanuc move off the wall along the first axis: a parameter of the machine, 1 or -1.
    pub bore_shift: f64,
    /// The control is a lathe's, and X counts diameters, or not; `None`: as its file says.
    pub by_diameter: Option<bool>,
}

/// What a length without a point means on a Fanuc: a setting of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Unpointed {
    /// A length without a point is an error: nothing is known of it.
    #[default]
    Refused,
    /// Whole inches or millimetres.
    Whole,
    /// Least increments: 0.0001 inch, 0.001 mm or degrees.
    Increments,
}

impl RunSettings {
    /// The settings of a control as it is switched on.
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
