//! What is printed before a motion sequence that does not print it: the plane, the feed.

use super::fault::{Done, fault_at};
use super::renderer::Renderer;
use crate::compile::Block;
use crate::diag::Code;
use crate::lang::{Machine, VarId};
use crate::sema;

impl Renderer<'_> {
    /// The plane's code as a block of its own, before what prints none and needs it.
    pub(super) fn plane_block(&mut self, plane: f64, block: &Block) -> Done {
        if self.plane == plane || self.says_code(block, |code| (17.0..20.0).contains(&code)) {
            return Ok(());
        }
        self.enter_plane(plane)
    }

    /// The plane's code as a block of its own, where the control is in another; only mills have planes.
    pub(super) fn enter_plane(&mut self, plane: f64) -> Done {
        if self.plane != plane && self.program.settings.machine == Machine::Mill {
            self.code_word(&sema::Code::plain(b'G', plane))?;
            self.end_block();
        }
        Ok(())
    }

    /// The feed as a block of its own, before a sequence that prints none.
    pub(super) fn feed_block(&mut self, block: &Block) -> Done {
        if !block.vars.has(VarId::Frate) {
            if self.inverse_time() {
                let message = "in inverse time each move says its feed, and the sequence does not print [frate]";
                return fault_at(Code::PR017, message, "add `F[frate]` to the sequence", Some(block.span));
            }
            self.feed_word()?;
            self.end_block();
        }
        Ok(())
    }
}
