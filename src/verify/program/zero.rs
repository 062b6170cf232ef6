//! The zero from which a program measures its positions: the work offset, with the shifts of G52 and G92.

use std::rc::Rc;

use super::{Program, State};
use crate::diag::Code;
use crate::nc::Action;
use crate::verify::cut::DEPTH;
use crate::verify::measured::{Across, Frames, Level, Zero};

impl Program<'_> {
    /// Runs a block that moves the zero, or that sets tool data.
    pub(super) fn zero_moves(&mut self, action: &Action, line: u64) {
        self.moves_zero = true;
        self.passage.tool_data.extend(self.simulator.tool_data());
        let stays = self.scale.flat && !self.frame_goes_across();
        // a shift from an unknown position is reported at the first move in the new frame
        let is_reported_later = self.scale.axes(self.simulator.state().frame_unknown()) != 0;
        if *action != Action::Frame || !stays && !is_reported_later {
            let message = "the program moves its coordinate frame, so the positions of the job are shifted";
            self.hazard(Code::PV021, line, message, "remove G10, G52 or G92");
        }
    }

    /// Compares the frames of the rapids from now on.
    pub fn measure_rapids(&mut self) {
        self.frames = Some(Rc::new(self.active_frames()));
    }

    /// The frames in which the program measures its positions now. `None`: the frames of rapids are not compared.
    pub fn frames(&self) -> Option<&Rc<Frames>> {
        self.frames.as_ref()
    }

    /// Updates the frames after an action that is no motion.
    pub(super) fn reframe(&mut self) {
        if self.frames.is_some() {
            self.measure_rapids();
        }
    }

    fn active_frames(&self) -> Frames {
        let Zero { mut at, angle, .. } = self.zero();
        let height = std::mem::take(&mut at[DEPTH]);
        let State { tool, work, length, side, diameter, .. } = *self.state;
        Frames {
            across: Across { work, zero: at, angle, side: side.flatten(), diameter },
            level: Level { tool, work, length, zero: height },
        }
    }

    /// All work offsets by number: 0 shifts all other offsets, 1 is G54, 10 is the first additional offset.
    pub fn offsets(&self) -> impl Iterator<Item = Zero> {
        let offsets = self.simulator.state().offsets();
        offsets.map(|(at, angle, set)| Zero { at: self.scale.place(&at), angle, set, unknown: 0 })
    }

    /// The active zero.
    pub fn zero(&self) -> Zero {
        let state = self.simulator.state();
        let (at, angle) = state.zero();
        Zero { at: self.scale.place(&at), angle, set: state.offset_given(), unknown: state.frame_unknown() }
    }
}
