//! Finds hazards in a program: dangerous blocks that no control refuses. Hazards are found while the program runs,
//! without the job.

use super::Program;
use crate::control::{Rules, ToolLength};
use crate::diag::Code;
use crate::nc::{Action, Compensation, Item, Rotation};
use crate::verify::beside::Compensated;
use crate::verify::finding::Finding;

impl Program<'_> {
    /// Reports a move in a frame that G92 set while the position was known only at the machine.
    pub(super) fn check_frame(&mut self, unknown: u8, line: u64) {
        if self.scale.axes(self.simulator.state().frame_unknown()) & !unknown != 0 {
            let message = "the program moves in a frame that G92 set at an unknown machine position";
            self.hazard(Code::PV021, line, message, "remove G92, or write the positions of its axes before G92");
        }
    }

    /// Whether the program moves its coordinate frame along X or Y. For a form without depth axis, a move along Z is allowed.
    pub(super) fn frame_goes_across(&self) -> bool {
        let state = self.simulator.state();
        state.frame_unknown() & 0b11 != 0 || state.frame_shift()[..2] != [0.0; 2] || self.simulator.sets_offset_across()
    }

    pub(super) fn units_are_due(&mut self, line: u64, message: &str) {
        if self.due.units() {
            let help = "print G[unitmode] in StartCode; if the form is for one unit, give --form";
            self.hazard(Code::PV022, line, message, help);
        }
    }

    pub(super) fn length_is_due(&self) -> bool {
        self.due.lengths() && self.state.tool.is_some() && self.state.length.is_none()
    }

    pub(super) fn without_length(&mut self, line: u64, message: &str) {
        if self.due.reports_length() {
            self.hazard(Code::PV014, line, message, self.due.length_help());
        }
    }

    /// Changes the register of the tool length.
    pub(super) fn length(&mut self, register: Option<f64>, line: u64) {
        let has_lengths = self.control.is_lathe() || self.control.traits().tool_length != ToolLength::None;
        if register.is_some() && !has_lengths {
            let message = "the program turns a tool length offset on, but this control has none";
            self.hazard(Code::PV014, line, message, "remove G43, or name a control with tool lengths");
        }
        self.due.length_changes(self.state.length, register, self.simulator.ends_length());
        self.is_relengthened |= self.state.length != register;
        self.state.length = register;
        // the program gives the length as a number: G43.1
        self.moves_zero |= register == Some(0.0);
    }

    /// Switches the cutter compensation.
    pub(super) fn compensation(&mut self, on: Option<Compensation>, line: u64) {
        let register = on.and_then(|on| on.cutter.register());
        self.state.cutter = on.and_then(|on| self.scale.cutter(on.cutter));
        let side = Some(on.map(|on| on.side));
        if side == self.state.side && self.state.diameter.is_some_and(|before| Some(before) != register) {
            let message = "the offset register changes while the compensation is on";
            self.hazard(Code::PV018, line, message, "print one D for each contour");
        }
        (self.state.side, self.state.diameter) = (side, register);
        self.passage.side = on.map(|on| Compensated { side: on.side, register });
    }

    /// Checks the end of the program.
    pub fn ended(&mut self) {
        let line = self.simulator.line();
        if self.simulator.begins_again() {
            self.hazard(
                Code::PV016,
                line,
                "the program ends with M99, which starts it again",
                "end the program with M30 or M2",
            );
        } else if !self.ended && self.control.rules() == Rules::Fanuc {
            self.hazard(Code::PV016, line, "the program has no end", "print M30 or M2 in EndCode");
        } else if !self.ended && self.state.rotation != Some(Rotation::Stop) {
            // `%` ends the program and switches neither spindle nor coolant off
            self.hazard(Code::PV016, line, "the program ends while its spindle turns", "print M2 or M30 in EndCode");
        }
    }

    /// Finds a move between M29 and the tap: the control stops there with the alarm 204.
    pub(super) fn moves_after_rigid(&mut self, item: &Item) {
        let moves = matches!(item.action, Action::Rapid { .. } | Action::Feed { .. } | Action::Arc(_));
        self.is_rigid_ahead = !moves;
        if moves && !item.by_cycle {
            let message = "an axis moves between M29 and the tap: the control stops with an alarm";
            self.hazard(Code::PV011, item.line, message, "print M29 on the line before the tapping cycle");
        }
    }

    pub(super) fn hazard(&mut self, code: Code, line: u64, message: &str, help: &'static str) {
        // a form repeats the same mistake at every tool, so it is reported once and counted
        if let Some(told) = self.hazards.iter_mut().find(|told| told.code == code && told.message == message) {
            told.times += 1;
            return;
        }
        let block = self.text();
        let (message, place, form) = (message.into(), None, None);
        self.hazards.push(Finding { code, message, help, place, line, block, form, times: 1 });
    }
}
