//! What a program has not set yet, and what was reported of that.

use super::expectation::Expectation;
use crate::control::{Control, ToolLength};

/// What a program has not set yet, and what was reported of that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Due {
    lengths: bool,
    length_reported: bool,
    /// A length offset was on, and the program has taken it off.
    length_off: bool,
    units: bool,
}

impl Due {
    /// Of a program that has set nothing.
    pub fn new(expectation: &Expectation, control: &Control) -> Due {
        let has_lengths = control.traits().tool_length != ToolLength::None;
        let lengths = expectation.tools && expectation.lengths_due && has_lengths;
        Due { lengths, length_reported: false, length_off: false, units: expectation.units_due }
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

    /// The length offset changes from one register to another.
    pub fn length_changes(&mut self, from: Option<f64>, to: Option<f64>) {
        self.length_off = to.is_none() && (self.length_off || from.is_some());
    }

    /// What to print instead, where no length offset is on.
    pub fn length_help(&self) -> &'static str {
        match self.length_off {
            false => "print G43 H[lcomp] in the tool change, before the height",
            true => {
                "after G49 a height counts without the tool: go to the machine's own height, by `G91 G28 Z0` and `G90`, or `G53 G0 Z0`"
            }
        }
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
