//! Motion sequences of a form: what they must print, and what is printed before them where they do not.

use super::fault::{Done, fault_at};
use super::renderer::Renderer;
use crate::compile::{Block, Op};
use crate::diag::Code;
use crate::lang::{Machine, VarId};
use crate::sema;
use crate::toolpath::Axes;

impl Renderer<'_> {
    /// A motion sequence must print every axis that moves: a word that the form leaves out is a move that is lost.
    pub(super) fn sequence_says(&self, block: &Block, target: &Axes) -> Done {
        use VarId as V;
        const WORDS: [&[VarId]; 3] = [&[V::H, V::Hdist], &[V::V, V::Vdist], &[V::D, V::Ddist]];
        const WIRE: [&[VarId]; 4] = [WORDS[0], WORDS[1], &[V::H2], &[V::V2]];
        let words: &[&[VarId]] = if self.linear == WIRE.len() { &WIRE } else { &WORDS };
        let moves = |axis: usize| target.get(axis).is_some() && target.get(axis) != self.position.get(axis);
        let lost =
            words.iter().enumerate().find(|&(axis, vars)| moves(axis) && !vars.iter().any(|&v| block.vars.has(v)));
        let turns = self.turned_axes(target).find(|&axis| !self.says_angle(block, axis));
        let word = match (lost, turns) {
            (Some((_, vars)), _) => format!("[{}]", vars[0].name()),
            (None, Some(axis)) => format!("{}[rotangle]", char::from(self.axes[axis])),
            (None, None) => return Ok(()),
        };
        let message = format!("this move changes {word}, which the sequence does not print");
        fault_at(Code::PR017, message, format!("add the word of {word} to the sequence"), Some(block.span))
    }

    /// The plane's code as a block of its own, before what prints none and needs it.
    pub(super) fn plane_block(&mut self, plane: f64, block: &Block) -> Done {
        let program = self.program;
        let says = block.ops.clone().any(|i| match program.ops[i] {
            Op::Literal { index, .. } => {
                let literal = &program.literals[index as usize];
                literal.letter == b'G' && (17.0..20.0).contains(&literal.value)
            }
            _ => false,
        });
        if says || self.plane == plane || program.settings.machine != Machine::Mill {
            return Ok(());
        }
        self.code_word(&sema::Code::plain(b'G', plane))?;
        self.end_block();
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
