//! The texts of the program's lines, for findings.

use super::Program;
use crate::source::text_of;
use crate::verify::recent_lines::Recent;

impl Program<'_> {
    /// The text of the current line.
    pub fn text(&self) -> String {
        text_of(self.simulator.text()).trim().to_owned()
    }

    /// The text of a recent line; empty if the line is no longer kept.
    pub fn text_of(&self, line: u64) -> String {
        let now = || (line == self.simulator.line()).then(|| self.text());
        self.recent.text(line).or_else(now).unwrap_or_default()
    }

    /// The block number of a line as written: `N120`.
    pub fn number_of(&self, line: u64) -> String {
        Recent::number(&self.text_of(line))
    }
}
