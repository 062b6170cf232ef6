//! What a caller may say about a CL file that the file leaves open.

use super::dialect::Dialect;
use crate::toolpath::{Spindle, SpindleTurn, Units};

/// What a caller may choose.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Who wrote the file; else it is told from its first lines.
    pub dialect: Option<Dialect>,
    /// Units of a file that does not say them.
    pub units: Option<Units>,
    /// The tool of a file that loads none, or each by its name.
    pub tool: Option<Assumed>,
    /// The spindle of tools for which the file says none.
    pub speed: Option<AssumedSpeed>,
    /// The feed until the file says one: lengths of the file a minute.
    pub feed: Option<f64>,
    /// Where the tool is before the first motion, of a file that begins with a cut.
    pub start: Option<[f64; 3]>,
    /// The file is whole, though it does not end as its system ends files.
    pub end: bool,
    /// Which of its setups is read, counted from 1, in a frame of its own; else the file is one setup.
    pub setup: Option<usize>,
}

/// Largest spindle speed.
const FASTEST: f64 = 1e6;

/// A spindle that a file does not say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssumedSpeed {
    /// Revolutions a minute.
    pub rpm: f64,
    /// Counter-clockwise.
    pub ccw: bool,
}

impl AssumedSpeed {
    /// As `--assume-speed` says it: `3000`, or `3000,CCLW`.
    ///
    /// # Errors
    /// What to write instead.
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

    /// As events have it.
    pub(super) fn spindle(self) -> Spindle {
        let turn = if self.ccw { SpindleTurn::Ccw } else { SpindleTurn::Cw };
        Spindle { speed: Some(self.rpm), turn: Some(turn), ..Spindle::default() }
    }
}

/// A position as `--assume-start` says it: `X,Y,Z`.
///
/// # Errors
/// What to write instead.
pub fn parse_position(text: &str) -> Result<[f64; 3], String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|n: &f64| n.is_finite())).collect();
    match numbers.as_deref() {
        Some([x, y, z]) => Ok([*x, *y, *z]),
        _ => Err("write X,Y,Z in units of the file, as 0,0,100".to_owned()),
    }
}

/// Largest tool number.
const LARGEST: u32 = 99_999_999;

/// Numbers of tools that a file does not load.
#[derive(Clone, Debug, PartialEq)]
pub enum Assumed {
    /// Of its only tool.
    One(f64),
    /// Of each tool that it names.
    Named(Vec<(String, f64)>),
}

impl Assumed {
    /// As `--assume-tool` says them: `1`, or `FACE_MILL=1,DRILL=2`.
    ///
    /// # Errors
    /// What to write instead.
    pub fn parse(text: &str) -> Result<Assumed, String> {
        let number = |text: &str| text.trim().parse::<u32>().ok().filter(|n| *n <= LARGEST).map(f64::from);
        // statements have no blanks and no small letters
        let name = |text: &str| text.split_whitespace().collect::<String>().to_ascii_uppercase();
        let pair = |text: &str| text.split_once('=').and_then(|(tool, n)| Some((name(tool), number(n)?)));
        let named = || text.split(',').map(pair).collect::<Option<Vec<_>>>().map(Assumed::Named);
        let read = number(text).map(Assumed::One).or_else(named);
        read.ok_or_else(|| format!("write a number up to {LARGEST}, or NAME=1,OTHER=2"))
    }

    /// The number, where one is said for all.
    pub fn one(&self) -> Option<f64> {
        if let Assumed::One(number) = self { Some(*number) } else { None }
    }

    /// The number of the tool of that name, where each has its own.
    pub(super) fn of(&self, tool: &str) -> Option<f64> {
        match self {
            Assumed::One(_) => None,
            Assumed::Named(list) => list.iter().find(|(name, _)| name == tool).map(|(_, number)| *number),
        }
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
