//! A machine, as its file describes it: travels, offsets, tools, fixtures.
//!
//! Lengths are millimetres inside, whatever the file counts in. What a file does not say is not checked.

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
    /// What the shop calls it.
    pub name: String,
    /// Its control, where the file names one.
    pub control: Option<&'static Control>,
    /// In what messages about it count lengths.
    pub units: Units,
    /// It is a lathe whose X counts diameters, in the file and in messages; inside X is a radius.
    pub by_diameter: bool,
    /// X Y Z A B C, those that the file describes.
    pub axes: [Option<Axis>; 6],
    /// How its control goes through corners, for times.
    pub corners: Corners,
    /// Where the rotary axes turn, in machine coordinates.
    pub rotary: Option<Rotary>,
    /// Where G28 and G30 go, in machine coordinates: millimetres and degrees.
    pub references: [Option<[f64; 6]>; 2],
    /// Least and greatest speed of the spindle, in revolutions a minute.
    pub speeds: Option<[f64; 2]>,
    /// Seconds from standing to the highest speed.
    pub spin_up: Option<f64>,
    /// How many tools its magazine holds.
    pub places: Option<u32>,
    /// Seconds of a tool change, from chip to chip.
    pub change: Option<f64>,
    /// Its tools, where the file or one that it names lists them.
    pub tools: Option<ToolTable>,
    /// Its work offsets by their numbers, as `offsets::number` counts them: G54 is 1, the first additional one 10.
    pub offsets: Option<BTreeMap<usize, [Option<f64>; 6]>>,
    /// The kinds of coolant that it has.
    pub coolant: Option<Vec<Coolant>>,
    /// How many bytes of a program its control stores.
    pub bytes: Option<u64>,
    /// The least and greatest program number.
    pub numbers: Option<[u32; 2]>,
    /// What no rapid may enter.
    pub fixtures: Vec<Fixture>,
}

/// The rotary axes: read and checked, and used where planes are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rotary {
    /// Letters of the axes, first the one nearest the machine's frame.
    pub order: Vec<char>,
    /// Where they meet, in machine coordinates, millimetres.
    pub centre: [f64; 3],
    /// The control keeps the tip of the tool while they turn.
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
    /// Its name, as files write it.
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

    /// The work offset with this number; `None` for one, or for an axis of it, that the file does not give.
    pub fn offset(&self, number: usize) -> Option<&[Option<f64>; 6]> {
        self.offsets.as_ref()?.get(&number)
    }
}

/// A number without needless zeros; `parts`: how many parts of one are shown.
fn short(value: f64, parts: f64) -> String {
    format!("{}", (value * parts).round() / parts + 0.0)
}

/// The letters of the axes.
pub const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
