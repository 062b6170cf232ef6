//! Cuts and the ways to them: what job and program are compared by.

use crate::nc::{Cooling, Rotation, Turn};
use crate::toolpath::{FeedMode, Plane, Side};

/// A place: X Y Z in the job's units and A B C in degrees.
pub(super) type Place = [f64; 6];

/// A rapid on the way to a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rapid {
    pub to: Place,
    /// Axes whose place only the machine knows.
    pub unknown: u8,
    /// What the spindle does, where it matters.
    pub rotation: Option<Rotation>,
}

/// What is done where the way ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum What {
    /// A straight feed move.
    Line { to: Place },
    /// An arc.
    Arc(Turn),
    /// A dwell in seconds, right behind a cut.
    Dwell(f64),
}

impl What {
    /// Where it ends.
    pub fn end(&self, from: &Place) -> Place {
        match self {
            What::Line { to } => *to,
            What::Arc(turn) => turn.to,
            What::Dwell(_) => *from,
        }
    }

    /// Does it feed?
    pub fn feeds(&self) -> bool {
        matches!(self, What::Line { .. } | What::Arc(_))
    }
}

/// What is in force at a cut; `None` is not known, or does not matter.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(super) struct State {
    pub tool: Option<f64>,
    pub work: Option<f64>,
    pub rotation: Option<Rotation>,
    pub speed: Option<f64>,
    /// Coolant.
    pub coolant: Option<Cooling>,
    /// Cutter compensation: `None` inside is off.
    pub side: Option<Option<Side>>,
    /// Registers of tool length, and of the diameter while compensation is on.
    pub length: Option<f64>,
    pub diameter: Option<f64>,
    /// The speed is a surface speed.
    pub css: bool,
    /// The plane that compensation is in.
    pub plane: Plane,
}

/// A cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub from: Place,
    /// Axes of `from` that only the machine knows.
    pub unknown: u8,
    pub what: What,
    pub feed: Option<f64>,
    pub mode: FeedMode,
    pub state: State,
    /// A canned cycle of the control makes it.
    pub by_cycle: bool,
    /// The program's line, or 0.
    pub line: u64,
}

/// The axes as bits.
pub(super) const ALL: u8 = 0b11_1111;
/// The axis along which holes go, as an index.
pub(super) const DEPTH: usize = 2;
/// All but the depth.
pub(super) const ACROSS: u8 = ALL & !(1 << DEPTH);

/// Are two places one, on these axes? An angle and the same after a whole turn are.
pub(super) fn same(a: &Place, b: &Place, axes: u8, tolerance: f64) -> bool {
    (0..6).filter(|axis| axes & 1 << axis != 0).all(|axis| {
        let difference = a[axis] - b[axis];
        difference.abs() <= tolerance
            || (axis >= 3 && (difference - 360.0 * (difference / 360.0).round()).abs() <= tolerance.max(0.001))
    })
}

/// Do two cuts turn their angles as far?
pub(super) fn turn_as_far(a: [&Place; 2], b: [&Place; 2]) -> bool {
    (3..6).all(|axis| ((a[1][axis] - a[0][axis]) - (b[1][axis] - b[0][axis])).abs() <= 0.002)
}

/// Is b on the straight way from a to c?
pub(super) fn lies_between(a: &Place, b: &Place, c: &Place, tolerance: f64) -> bool {
    let (mut along, mut length) = (0.0, 0.0);
    for axis in 0..6 {
        along += (b[axis] - a[axis]) * (c[axis] - a[axis]);
        length += (c[axis] - a[axis]).powi(2);
    }
    let part = along / length;
    (0.0..=1.0).contains(&part)
        && (0..6).all(|axis| (a[axis] + part * (c[axis] - a[axis]) - b[axis]).abs() <= tolerance)
}

/// `X1 Y2.5 Z-0.1`, with angles where there are any.
pub(super) fn shown(place: &Place, axes: u8) -> String {
    let words = (0..6).filter(|&axis| axes & 1 << axis != 0);
    let list: Vec<String> =
        words.map(|axis| format!("{}{}", char::from(b"XYZABC"[axis]), number(place[axis]))).collect();
    list.join(" ")
}

/// Where a hole is: X and Y, and angles that are not zero.
pub(super) fn over(place: &Place) -> String {
    let turned = (3..6).filter(|&axis| place[axis] != 0.0).map(|axis| 1 << axis).sum::<u8>();
    shown(place, 0b11 | turned)
}

/// A number as a person reads it.
pub(super) fn number(value: f64) -> f64 {
    let rounded = (value * 1e5).round() / 1e5;
    if rounded == 0.0 { 0.0 } else { rounded }
}

/// Two dwells in seconds are one: revolutions as a time are not whole milliseconds.
pub(super) fn same_dwell(wanted: f64, is: f64) -> bool {
    (wanted - is).abs() <= (0.01 * wanted).max(0.001)
}
