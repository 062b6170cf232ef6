//! A machine, as its file describes it: travels, offsets, tools, fixtures.
//!
//! Lengths are in millimetres internally, in any units of the file. A value that the file does not contain is not checked.

mod axis;
mod file;
mod file_text;
mod fixture;
pub mod offsets;
mod rates;
mod summary;
mod template;
mod tool_table;

pub use axis::{Axis, Travel};
pub use fixture::{Fixture, Sweep};
pub use rates::Corners;
pub use summary::summary;
pub use template::template;
pub use tool_table::ToolTable;

use std::collections::BTreeMap;

use crate::control::Control;
use crate::toolpath::Units;

pub use file::{Beside, read};

/// A machine.
#[derive(Clone, Debug, Default)]
pub struct Machine {
    /// Its name in the shop.
    pub name: String,
    /// Its control, if the file names one.
    pub control: Option<&'static Control>,
    /// The units of lengths in messages about it.
    pub units: Units,
    /// It is a lathe whose X is a diameter in the file and in messages; internally X is a radius.
    pub by_diameter: bool,
    /// X Y Z A B C; only the axes in the file.
    pub axes: [Option<Axis>; 6],
    /// Its behaviour in corners, for times.
    pub corners: Corners,
    /// The position of the rotary axes, in machine coordinates.
    pub rotary: Option<Rotary>,
    /// Targets of G28 and G30, in machine coordinates: millimetres and degrees.
    pub references: [Option<[f64; 6]>; 2],
    /// Least and greatest spindle speed, in revolutions per minute.
    pub speeds: Option<[f64; 2]>,
    /// Seconds from standstill to the highest speed.
    pub spin_up: Option<f64>,
    /// Number of tool places in its magazine.
    pub places: Option<u32>,
    /// Seconds of a tool change, from chip to chip.
    pub change: Option<f64>,
    /// Its tools, if the file or a file that it names lists them.
    pub tools: Option<ToolTable>,
    /// Its work offsets by their numbers in `offsets::number`: G54 is 1, the first additional one is 10.
    pub offsets: Option<BTreeMap<usize, [Option<f64>; 6]>>,
    /// The kinds of coolant that it has.
    pub coolant: Option<Vec<Coolant>>,
    /// Size of the program memory of its control, in bytes.
    pub bytes: Option<u64>,
    /// The least and greatest program number.
    pub numbers: Option<[u32; 2]>,
    /// Boxes that no rapid may enter.
    pub fixtures: Vec<Fixture>,
}

/// The rotary axes: read and checked, and used for planes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rotary {
    /// Letters of the axes, beginning with the axis nearest to the machine's frame.
    pub order: Vec<char>,
    /// Their intersection, in machine coordinates, in millimetres.
    pub centre: [f64; 3],
    /// The control keeps the tool tip in position while they turn.
    pub tip_control: bool,
}

/// A kind of coolant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coolant {
    Flood,
    Mist,
    Through,
    Air,
    High,
}

impl Coolant {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Coolant::Flood => "flood",
            Coolant::Mist => "mist",
            Coolant::Through => "through",
            Coolant::Air => "air",
            Coolant::High => "high",
        }
    }
}

impl Machine {
    /// A length for messages, in the units of the file.
    pub fn shown(&self, mm: f64) -> String {
        let parts = if self.units == Units::Inch { 1e4 } else { 1e3 };
        short(mm / self.units.in_mm(), parts)
    }

    /// A position of an axis for messages: degrees are degrees.
    pub fn at(&self, axis: usize, value: f64) -> String {
        match axis {
            0 if self.by_diameter => self.shown(value * 2.0),
            0..3 => self.shown(value),
            _ => short(value, 1e3),
        }
    }

    /// The work offset with this number; `None` for an offset or an axis that the file does not contain.
    pub fn offset(&self, number: usize) -> Option<&[Option<f64>; 6]> {
        self.offsets.as_ref()?.get(&number)
    }
}

/// A number without needless zeros; `parts` is the number of parts of one that are shown.
fn short(value: f64, parts: f64) -> String {
    format!("{}", (value * parts).round() / parts + 0.0)
}

/// The letters of the axes.
pub const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
