//! What a program does that no control would refuse and no shop wants: found on the way, whatever the job asks for.

use super::Program;
use crate::control::Rules;
use crate::diag::Code;
use crate::nc::Rotation;
use crate::verify::finding::Finding;

impl Program<'_> {
    /// A move in a frame that G92 set where only the machine knew the position is a hazard.
    pub(super) fn check_frame(&mut self, unknown: u8, line: u64) {
        if self.scale.axes(self.simulator.state().frame_unknown()) & !unknown != 0 {
            let message = "the program moves in a frame that G92 set where only the machine knows the position";
            self.hazard(Code::PV021, line, message, "take G92 out, or write the positions of its axes before it");
        }
    }

    /// Is the frame moved along X or Y? Along an ignored depth it may be.
    pub(super) fn frame_goes_across(&self) -> bool {
        let state = self.simulator.state();
        state.frame_unknown() & 0b11 != 0 || state.frame_shift()[..2] != [0.0; 2] || self.simulator.sets_offset_across()
    }

    pub(super) fn units_are_due(&mut self, line: u64, message: &str) {
        if self.due.units() {
            let help = "print G[unitmode] in StartCode, or give the form, if it is for one unit";
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

    /// Notes what the program did before its end, besides cutting.
    pub fn ended(&mut self) {
        let line = self.simulator.line();
        if self.simulator.begins_again() {
            self.hazard(Code::PV016, line, "the program ends with M99, which begins it again", "end it with M30 or M2");
        } else if !self.ended && self.control.rules() == Rules::Fanuc {
            self.hazard(Code::PV016, line, "nothing ends the program", "print M30 or M2 in EndCode");
        } else if !self.ended && self.state.rotation != Some(Rotation::Stop) {
            // `%` ends it, and switches nothing
            self.hazard(
                Code::PV016,
                line,
                "the program is over, and its spindle turns on",
                "print M2 or M30 in EndCode",
            );
        }
    }

    pub(super) fn hazard(&mut self, code: Code, line: u64, message: &str, help: &'static str) {
        // a form makes the same mistake at every tool
        if let Some(told) = self.hazards.iter_mut().find(|told| told.code == code && told.message == message) {
            told.times += 1;
            return;
        }
        let block = self.text();
        let (message, place, form) = (message.into(), None, None);
        self.hazards.push(Finding { code, message, help, place, line, block, form, times: 1 });
    }
}
