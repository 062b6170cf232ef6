//! The settings for ignored differences.

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
    /// The order of words in a block.
    pub order: bool,
}

impl Ignore {
    /// The names of all kinds.
    pub const NAMES: [&'static str; 6] = ["numbers", "comments", "spaces", "case", "format", "order"];

    /// Differences that have no effect on a machine: block numbers, spaces, case and the format of numbers.
    pub const USUAL: Ignore =
        Ignore { numbers: true, comments: false, spaces: true, case: true, format: true, order: false };

    /// Ignores a kind by its name; returns `false` if the name is unknown.
    pub fn set(&mut self, name: &str) -> bool {
        let field = match name {
            "numbers" => &mut self.numbers,
            "comments" => &mut self.comments,
            "spaces" => &mut self.spaces,
            "case" => &mut self.case,
            "format" => &mut self.format,
            "order" => &mut self.order,
            _ => return false,
        };
        *field = true;
        true
    }
}
