//! What a program has not set yet, and what was reported of that.

use super::expectation::Expectation;

/// What a program has not set yet, and what was reported of that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Due {
    lengths: bool,
    length_reported: bool,
    units: bool,
}

impl Due {
    /// Of a program that has set nothing.
    pub fn new(expectation: &Expectation) -> Due {
        let lengths = expectation.tools && expectation.lengths_due;
        Due { lengths, length_reported: false, units: expectation.units_due }
    }

    /// The program sets its units.
    pub fn units_are_set(&mut self) {
        self.units = false;
    }

    /// Are the units due? Answers `true` once.
    pub fn units(&mut self) -> bool {
        std::mem::take(&mut self.units)
    }

    /// Do tools need their length offset?
    pub fn lengths(&self) -> bool {
        self.lengths
    }

    /// Another tool has another length.
    pub fn new_tool(&mut self) {
        self.length_reported = false;
    }

    /// Is a missing length to be reported? Answers `true` once a tool.
    pub fn reports_length(&mut self) -> bool {
        !std::mem::replace(&mut self.length_reported, true)
    }
}
