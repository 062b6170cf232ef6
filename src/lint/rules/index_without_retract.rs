//! PF420: a part that turns under a tool which is still down.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in view.these(&[SequenceId::Index, SequenceId::Unwind]) {
        let mut up = false;
        for block in view.blocks(body) {
            let turn = block.line.words.iter().find(|word| word.letter().is_some_and(|letter| view.is_rotary(letter)));
            let down = block.axis_words.iter().find(|(word, axis)| *axis == 2 && word.printed_var().is_some());
            if let (true, Some(turn), Some((down, _))) = (block.in_part(), turn, down) {
                diags.push(
                    Diag::new(Code::PF420, format!("{} turns the part while the tool comes down", body.name()))
                        .at(turn.span, "turns here")
                        .at(down.span, "in the same block")
                        .help("turn in a block of its own, before the depth"),
                );
                break;
            }
            if let (false, Some(turn)) = (up, turn) {
                diags.push(
                    Diag::new(Code::PF420, format!("{} turns the part before the tool is up", body.name()))
                        .at(turn.span, "turns here")
                        .help("lift the tool first, as `G0 G53 Z0` or `G91 G28 Z0`"),
                );
                break;
            }
            up |= block.retracts();
        }
    }
}
