//! What a caller may say about a CL file that the file leaves open.

use super::dialect::Dialect;
use crate::toolpath::Units;

/// What a caller may choose.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Who wrote the file; else it is told from its first lines.
    pub dialect: Option<Dialect>,
    /// Units of a file that does not say them.
    pub units: Option<Units>,
    /// The tool of a file that loads none, or each by its name.
    pub tool: Option<Assumed>,
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
}
