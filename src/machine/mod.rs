//! The machine as its file describes it: travels, offsets, tools, fixtures.
//!
//! The file may use any units; here lengths are in millimetres. If the file does not contain a value, the check that
//! needs this value is not made.

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
use crate::toolpath::{Coolant, Units};

pub use file::{Beside, read};

/// A machine.
#[derive(Clone, Debug, Default)]
pub struct Machine {
    /// Name of the machine in the shop.
    pub name: String,
    /// Control of the machine, if the file names it.
    pub control: Option<&'static Control>,
    /// The units of lengths in messages about the machine.
    pub units: Units,
    /// Whether the machine is a lathe whose X is a diameter in the file and in messages. In this type, X is always a
    /// radius.
    pub by_diameter: bool,
    /// The axes X Y Z A B C. Axes that the file does not contain are `None`.
    pub axes: [Option<Axis>; 6],
    /// How the control moves through corners, for calculating times.
    pub corners: Corners,
    /// The rotary axes and their position in machine coordinates.
    pub rotary: Option<Rotary>,
    /// Targets of G28 and G30 in machine coordinates, in millimetres and degrees.
    pub references: [Option<[f64; 6]>; 2],
    /// Least and greatest spindle speed, in revolutions per minute.
    pub speeds: Option<[f64; 2]>,
    /// Seconds that the spindle needs from standstill to its highest speed.
    pub spin_up: Option<f64>,
    /// Number of tools that the magazine can hold.
    pub places: Option<u32>,
    /// Seconds of a tool change from chip to chip (from the end of one cut to the next).
    pub change: Option<f64>,
    /// The tools, if the machine file lists tools or names a file that lists tools.
    pub tools: Option<ToolTable>,
    /// The work offsets, by their numbers as in `offsets::number`: G54 is 1, and the first additional offset is 10.
    pub offsets: Option<BTreeMap<usize, [Option<f64>; 6]>>,
    /// The kinds of coolant that the machine has.
    pub coolant: Option<Vec<Coolant>>,
    /// Size of the control's program memory, in bytes.
    pub bytes: Option<u64>,
    /// The least and the greatest allowed program number.
    pub numbers: Option<[u32; 2]>,
    /// Boxes that no rapid may enter.
    pub fixtures: Vec<Fixture>,
}

/// The rotary axes. The values of the axes are read and checked, and used for planes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rotary {
    /// The letters of the axes. The first letter is the axis nearest to the frame of the machine.
    pub order: Vec<char>,
    /// The point where the axes intersect, in machine coordinates, in millimetres.
    pub centre: [f64; 3],
    /// Whether the control keeps the position of the tool tip while the axes turn.
    pub tip_control: bool,
}

impl Machine {
    /// A length as text for messages, in the units of the file.
    pub fn shown(&self, mm: f64) -> String {
        let parts = if self.units == Units::Inch { 1e4 } else { 1e3 };
        short(mm / self.units.in_mm(), parts)
    }

    /// A position of an axis as text for messages. Angles are in degrees.
    pub fn at(&self, axis: usize, value: f64) -> String {
        match axis {
            0 if self.by_diameter => self.shown(value * 2.0),
            0..3 => self.shown(value),
            _ => short(value, 1e3),
        }
    }

    /// The work offset with this number. `None`: the file does not contain this offset or this axis.
    pub fn offset(&self, number: usize) -> Option<&[Option<f64>; 6]> {
        self.offsets.as_ref()?.get(&number)
    }
}

/// A number as text, without unneeded zeros. The number is rounded to 1/`parts`.
fn short(value: f64, parts: f64) -> String {
    format!("{}", (value * parts).round() / parts + 0.0)
}

/// The letters of the axes.
pub const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
