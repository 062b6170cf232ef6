//! What is printed before a motion sequence that does not print it: the plane, the feed.

use super::fault::{Done, fault_at};
use super::numbers::tenths;
use super::renderer::Renderer;
use crate::compile::Routine;
use crate::diag::Code;
use crate::lang::{Machine, VarId};
use crate::sema;

impl Renderer<'_> {
    /// The plane's code as a block of its own, before what prints none and needs it.
    pub(super) fn plane_block(&mut self, plane: f64, routine: &Routine) -> Done {
        if self.plane == plane || self.says_code(routine, b'G', |code| self.is_plane(code)) {
            return Ok(());
        }
        self.enter_plane(plane)
    }

    /// The plane's code as a block of its own, where the control is in another; only mills have planes.
    pub(super) fn enter_plane(&mut self, plane: f64) -> Done {
        if self.plane != plane && self.shape.program.settings.machine == Machine::Mill {
            self.code_word(&sema::Code::plain(b'G', plane))?;
            self.out.end_block();
        }
        Ok(())
    }

    /// The motion code, before a sequence of moves that prints none where the control is in another motion: a cut would
    /// be a rapid. Whether it was printed.
    fn motion_before(&mut self, code: &sema::Code, routine: &Routine) -> Done<bool> {
        let lacks = !self.motion_in_force(code) && self.shape.program.speaks_g && !self.says_motion(routine);
        if lacks {
            self.code_word(code)?;
        }
        Ok(lacks)
    }

    /// The motion code as a block of its own, before a sequence of rapids that prints none.
    pub(super) fn motion_block(&mut self, code: &sema::Code, routine: &Routine) -> Done {
        self.motion_before(code, routine)?;
        self.out.end_block();
        Ok(())
    }

    /// The motion before a sequence that goes to a place and says none: a cut's is a cut, every other way a rapid.
    pub(super) fn way_before(&mut self, routine: &Routine) -> Done {
        let program = self.shape.program;
        let code = if self.cutting { &program.settings.feed } else { &program.settings.rapid };
        let known = self.in_motion == Some(tenths(code.value));
        if known || !program.speaks_g || !self.goes_unsaid(routine) {
            return Ok(());
        }
        self.code_word(code)?;
        if self.cutting && !self.inverse_time() {
            self.feed_word()?;
        }
        self.out.end_block();
        Ok(())
    }

    /// Motion code and feed as a block of their own, before a sequence that lacks one of them; arcs say their code.
    pub(super) fn feed_block(&mut self, code: &sema::Code, routine: &Routine) -> Done {
        let begun = code.value == self.shape.program.settings.feed.value && self.motion_before(code, routine)?;
        let says_feed = routine.vars.has(VarId::Frate);
        if !says_feed && self.inverse_time() {
            let message = "in inverse time each move says its feed, and the sequence does not print [frate]";
            return fault_at(Code::PR017, message, "add `F[frate]` to the sequence", Some(routine.span));
        }
        // a Grbl refuses G1 before any feed
        if !says_feed || begun && !self.inverse_time() {
            self.feed_word()?;
        }
        self.out.end_block();
        Ok(())
    }
}
