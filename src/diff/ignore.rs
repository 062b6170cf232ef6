//! The settings for ignored differences.

use crate::nc::Number;

/// The kinds of differences that are ignored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Ignore {
    /// Block numbers.
    pub numbers: bool,
    /// Comments, and lines that contain only comments.
    pub comments: bool,
    /// Spaces, line ends, and empty lines.
    pub spaces: bool,
    /// Upper and lower case of words.
    pub case: bool,
    /// Leading and trailing zeros, plus signs, and the minus sign of zero.
    pub format: bool,
    /// Missing decimal points: X5 and X5. are equal.
    pub points: bool,
    /// The order of words in a block.
    pub order: bool,
}

impl Ignore {
    /// The names of all kinds.
    pub const NAMES: [&'static str; 7] = ["numbers", "comments", "spaces", "case", "format", "points", "order"];

    /// Differences that have no effect on a machine: block numbers to which no block refers, spaces, case and the format
    /// of numbers. A missing decimal point has an effect on many machines.
    pub const USUAL: Ignore =
        Ignore { numbers: true, comments: false, spaces: true, case: true, format: true, points: false, order: false };

    /// Ignores a kind by its name; returns `false` if the name is unknown.
    pub fn set(&mut self, name: &str) -> bool {
        let field = match name {
            "numbers" => &mut self.numbers,
            "comments" => &mut self.comments,
            "spaces" => &mut self.spaces,
            "case" => &mut self.case,
            "format" => &mut self.format,
            "points" => &mut self.points,
            "order" => &mut self.order,
            _ => return false,
        };
        *field = true;
        true
    }

    /// The value of a number for the comparison, if the format of numbers is ignored: its digits, and whether it is
    /// different from the same number with or without a decimal point. Zero is the same in both.
    pub(super) fn value(&self, number: Number) -> Option<(u64, bool)> {
        let value = number.value + 0.0; // -0 and 0 are equal
        self.format.then_some((value.to_bits(), number.point || self.points || value == 0.0))
    }
}
