//! Differences that do not count.

/// What two blocks may differ in and be the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Ignore {
    /// Block numbers.
    pub numbers: bool,
    /// Comments, and lines that hold nothing else.
    pub comments: bool,
    /// Blanks, line ends, and empty lines.
    pub spaces: bool,
    /// Upper and lower case of words.
    pub case: bool,
    /// Leading and trailing zeros, plus signs, a minus before zero.
    pub format: bool,
    /// The order of words in a block.
    pub order: bool,
}

impl Ignore {
    /// The names of all that can be ignored.
    pub const NAMES: [&'static str; 6] = ["numbers", "comments", "spaces", "case", "format", "order"];

    /// What a machine does not see: block numbers, blanks, case and the format of numbers.
    pub const USUAL: Ignore =
        Ignore { numbers: true, comments: false, spaces: true, case: true, format: true, order: false };

    /// Sets what can be ignored by its name; `false`: nothing has this name.
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
