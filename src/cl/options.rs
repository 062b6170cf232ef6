//! Options that give data which a CL file does not contain.

use super::dialect::Dialect;
use crate::toolpath::{Spindle, SpindleTurn, Units};

/// Options for reading a CL file.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The CAM system that wrote the file. Default: recognised from the first lines of the file.
    pub dialect: Option<Dialect>,
    /// The units to assume for a file that does not define them.
    pub units: Option<Units>,
    /// The tool number for a file that loads no tool, or a number for each tool that the file names.
    pub tool: Option<Assumed>,
    /// The spindle for tools whose spindle the file does not define.
    pub speed: Option<AssumedSpeed>,
    /// The feed until the first feed in the file, per minute in the file's units.
    pub feed: Option<f64>,
    /// The tool's position before the first motion, for a file that begins with a cut.
    pub start: Option<[f64; 3]>,
    /// Whether the file counts as complete without the last statement that its system normally writes.
    pub end: bool,
    /// Number of the setup to read, from 1. Positions are in the frame of the selected setup. Default: the file is read
    /// as one setup.
    pub setup: Option<usize>,
}

/// Largest allowed spindle speed.
const FASTEST: f64 = 1e6;

/// Spindle for a file that defines no spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssumedSpeed {
    /// Revolutions a minute.
    pub rpm: f64,
    /// Whether the spindle turns counter-clockwise.
    pub ccw: bool,
}

impl AssumedSpeed {
    /// Parses the value of `--assume-speed`: `3000`, or `3000,CCLW`.
    ///
    /// # Errors
    /// The text is invalid. The error describes the format.
    pub fn parse(text: &str) -> Result<AssumedSpeed, String> {
        let (speed, turn) = text.split_once(',').unwrap_or((text, "CLW"));
        let ccw = match turn.trim().to_ascii_uppercase().as_str() {
            "CLW" => Some(false),
            "CCLW" => Some(true),
            _ => None,
        };
        let rpm = speed.trim().parse::<f64>().ok().filter(|rpm| (0.0..=FASTEST).contains(rpm) && *rpm > 0.0);
        let read = rpm.zip(ccw).map(|(rpm, ccw)| AssumedSpeed { rpm, ccw });
        read.ok_or_else(|| "write revolutions a minute, as 3000 or 3000,CCLW".to_owned())
    }

    /// The spindle as an event value.
    pub(super) fn spindle(self) -> Spindle {
        let turn = if self.ccw { SpindleTurn::Ccw } else { SpindleTurn::Cw };
        Spindle { speed: Some(self.rpm), turn: Some(turn), ..Spindle::default() }
    }
}

/// Parses the value of `--assume-start`: `X,Y,Z`.
///
/// # Errors
/// The text is invalid. The error describes the format.
pub fn parse_position(text: &str) -> Result<[f64; 3], String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|n: &f64| n.is_finite())).collect();
    match numbers.as_deref() {
        Some([x, y, z]) => Ok([*x, *y, *z]),
        _ => Err("write X,Y,Z in units of the file, as 0,0,100".to_owned()),
    }
}

/// Largest allowed tool number.
const LARGEST: u32 = 99_999_999;

/// Numbers for tools that the file does not load.
#[derive(Clone, Debug, PartialEq)]
pub enum Assumed {
    /// Number of the only tool.
    One(f64),
    /// Number of each named tool.
    Named(Vec<(String, f64)>),
}

impl Assumed {
    /// Parses the value of `--assume-tool`: `1`, or `FACE_MILL=1,DRILL=2`.
    ///
    /// # Errors
    /// The text is invalid. The error describes the format.
    pub fn parse(text: &str) -> Result<Assumed, String> {
        let number = |text: &str| text.trim().parse::<u32>().ok().filter(|n| *n <= LARGEST).map(f64::from);
        let name = |text: &str| text.trim().to_ascii_uppercase();
        let pair = |text: &str| text.split_once('=').and_then(|(tool, n)| Some((name(tool), number(n)?)));
        let named = || text.split(',').map(pair).collect::<Option<Vec<_>>>().map(Assumed::Named);
        let read = number(text).map(Assumed::One).or_else(named);
        read.ok_or_else(|| format!("write a number up to {LARGEST}, or NAME=1,OTHER=2"))
    }

    /// The number if all numbers are for the only tool; `None` if tools have their own numbers.
    pub fn one(&self) -> Option<f64> {
        if let Assumed::One(number) = self { Some(*number) } else { None }
    }

    /// The names and their numbers; empty if there is one number for the only tool.
    pub fn named(&self) -> &[(String, f64)] {
        if let Assumed::Named(list) = self { list } else { &[] }
    }

    /// The number of a tool of a CL file. Names in CL files are compared without spaces, like the words of statements.
    pub(super) fn of(&self, tool: &str) -> Option<f64> {
        let is = |name: &str| name.split_whitespace().flat_map(str::chars).eq(tool.chars());
        self.named().iter().find(|(name, _)| is(name)).map(|(_, number)| *number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_assumed_for_one_tool_or_for_each() {
        assert_eq!(Assumed::parse("7"), Ok(Assumed::One(7.0)));
        let named = Assumed::parse("MILL=1,face mill = 2").unwrap();
        assert_eq!((named.of("MILL"), named.of("FACEMILL"), named.of("DRILL")), (Some(1.0), Some(2.0), None));
        for wrong in ["", "MILL", "MILL=", "MILL=1,DRILL", "100000000", "-1"] {
            assert!(Assumed::parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn speeds_and_positions_are_read_or_say_what_to_write() {
        assert_eq!(AssumedSpeed::parse("3000"), Ok(AssumedSpeed { rpm: 3000.0, ccw: false }));
        assert_eq!(AssumedSpeed::parse("1200.5, cclw"), Ok(AssumedSpeed { rpm: 1200.5, ccw: true }));
        for wrong in ["", "0", "-5", "nan", "1e9", "100,LEFT", "CLW"] {
            assert!(AssumedSpeed::parse(wrong).is_err(), "{wrong}");
        }
        assert_eq!(parse_position("1, -2.5,100"), Ok([1.0, -2.5, 100.0]));
        for wrong in ["", "1,2", "1,2,3,4", "1,2,inf", "x,y,z"] {
            assert!(parse_position(wrong).is_err(), "{wrong}");
        }
    }
}
