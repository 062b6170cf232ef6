//! PF440: `G0 Z0` moves to the zero of the part, usually its upper face, which is not a safe height for a tool change
//! or an index.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::blocks::Motion;
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    if !view.is_mill() || view.traits().height_is_machine {
        return; // without a length offset, Z0 is the home position
    }
    for body in view.these(&[S::ToolChange, S::EndCode, S::Index, S::Unwind]) {
        let rapid = |motion| matches!(motion, Motion::Rapid | Motion::Unknown);
        let offset_off = |word: &Word| view.meaning(word) == Some(Meaning::LengthOff);
        let blocks = view.blocks(body).iter();
        // after G49, Z0 is at or near the machine zero
        let blocks = blocks.filter(|block| block.in_part() && !block.incremental && rapid(block.motion));
        let blocks = blocks.filter(|block| !block.line.words.iter().any(offset_off));
        let zero = |word: &Word, axis| axis == 2 && word.letter().is_some_and(|letter| word.typed(letter) == Some(0.0));
        let word = blocks.flat_map(|block| &block.axis_words).find(|(word, axis)| zero(word, *axis));
        if let Some((word, _)) = word {
            diags.push(
                Diag::new(Code::PF440, format!("{} goes to the zero point of the part", body.name()))
                    .at(word.span, "on most parts the tool touches the part at this height")
                    .help("retract to the machine zero: `G0 G53 Z0`, or `G91 G28 Z0` and `G90`"),
            );
        }
    }
}
