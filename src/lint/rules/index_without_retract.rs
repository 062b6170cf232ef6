//! PF420: a rotary axis turns the part while the tool is still down.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    down_to_a_turning_part(view, diags);
    for body in view.these(&[SequenceId::Index, SequenceId::Unwind]) {
        let mut up = false;
        for block in view.blocks(body) {
            let turn = block.line.words.iter().find(|word| word.letter().is_some_and(|letter| view.is_rotary(letter)));
            let is_low = |var| matches!(var, Some(VarId::D | VarId::Vclear | VarId::Lastd));
            let down = block.axis_words.iter().find(|(word, axis)| *axis == 2 && is_low(word.printed_var()));
            if let (true, Some(turn), Some((down, _))) = (block.in_part(), turn, down) {
                diags.push(
                    Diag::new(Code::PF420, format!("{} turns the part while the tool comes down", body.name()))
                        .at(turn.span, "turns here")
                        .at(down.span, "in the same block")
                        .help("turn the part in a separate block before the depth"),
                );
                break;
            }
            if let (false, Some(turn)) = (up, turn) {
                diags.push(
                    Diag::new(Code::PF420, format!("{} turns the part before the tool retracts", body.name()))
                        .at(turn.span, "turns here")
                        .help("lift the tool first, as `G0 G53 Z0` or `G91 G28 Z0`"),
                );
                break;
            }
            up |= block.retracts();
        }
    }
}

/// Reports a tool change that moves the tool down before it prints the angle, so that the part turns under the tool.
fn down_to_a_turning_part(view: &View, diags: &mut Vec<Diag>) {
    let is_rotary = |word: &&Word| word.letter().is_some_and(|letter| view.is_rotary(letter)) && word.var().is_some();
    let Some(letter) = view.body(SequenceId::Index).and_then(|index| index.words().find(is_rotary)?.letter()) else {
        return;
    };
    for body in view.these(&[SequenceId::FirstToolChange, SequenceId::ToolChange]) {
        let mut words = body.words().take_while(|word| !is_rotary(word));
        let down = |word: &&Word| view.is_depth(word) && word.printed_var() == Some(VarId::D);
        if let Some(word) = words.find(down) {
            diags.push(
                Diag::new(Code::PF420, format!("{} brings the tool down before it turns the part", body.name()))
                    .at(word.span, "the part turns under the tool")
                    .help(format!("print `{}[rotangle]` with the position, before the depth", char::from(letter))),
            );
        }
    }
}
