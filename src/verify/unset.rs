//! Settings (units, length offset) that a program must make before its first move, and whether a missing setting was
//! reported.

use super::expectation::Expectation;
use crate::control::{Control, ToolLength};

/// Settings that the program has not made yet, and whether a missing setting was reported.
#[derive(Clone, Copy, Debug)]
pub(super) struct Due {
    lengths: bool,
    length_reported: bool,
    /// Whether the program turned a length offset on and then off.
    length_off: bool,
    /// Whether a move to the machine zero ended the length offset.
    ended_at_home: bool,
    units: bool,
}

impl Due {
    /// The state of a program that has set nothing yet.
    pub fn new(expectation: &Expectation, control: &Control) -> Due {
        let has_lengths = control.traits().tool_length != ToolLength::None;
        let lengths = expectation.tools && expectation.lengths_due && has_lengths;
        Due { lengths, length_reported: false, length_off: false, ended_at_home: false, units: expectation.units_due }
    }

    /// Records that the program sets its units.
    pub fn units_are_set(&mut self) {
        self.units = false;
    }

    /// Whether the units must still be set. Returns `true` only the first time, so that the finding is reported once.
    pub fn units(&mut self) -> bool {
        std::mem::take(&mut self.units)
    }

    /// Whether the units must still be set.
    pub fn has_units(&self) -> bool {
        self.units
    }

    /// Whether each tool must have a length offset.
    pub fn lengths(&self) -> bool {
        self.lengths
    }

    /// Records a change of the length offset from one register to another. `at_home`: a move to the machine zero ended
    /// the offset.
    pub fn length_changes(&mut self, from: Option<f64>, to: Option<f64>, at_home: bool) {
        self.ended_at_home = to.is_none() && at_home;
        self.length_off = to.is_none() && (self.length_off || from.is_some());
    }

    /// The correction for a missing length offset.
    pub fn length_help(&self) -> &'static str {
        if self.ended_at_home {
            return "this control ends the length offset at the machine zero (G28, G30, on some controls G53): print G43 \
                    H[lcomp] with the next height, for example in the sequence AfterHome or in Upon [work]";
        }
        match self.length_off {
            false => "print G43 H[lcomp] in the tool change, before the height",
            true => {
                "after G49 heights are without the tool length: move to the machine's own height, with `G91 G28 Z0` \
                 and `G90`, or `G53 G0 Z0`"
            }
        }
    }

    /// Records a new tool. A missing length offset is reported once for each tool.
    pub fn new_tool(&mut self) {
        self.length_reported = false;
    }

    /// Whether to report a missing length offset now. Returns `true` once for each tool.
    pub fn reports_length(&mut self) -> bool {
        !std::mem::replace(&mut self.length_reported, true)
    }
}
