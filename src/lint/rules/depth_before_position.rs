//! PF416: the tool moves down before it moves across to its position.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::Block;
use crate::lint::view::{Body, Purpose, View};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    if !view.is_mill() {
        return;
    }
    for body in &view.bodies {
        let moves = match body.purpose {
            Purpose::Sequence(id) => {
                matches!(id, S::FirstToolChange | S::ToolChange | S::Index | S::SubCall) || is_emulated(body, id)
            }
            Purpose::Upon(..) => true,
        };
        if !moves {
            continue;
        }
        let blocks = view.blocks(*body);
        let down = blocks.iter().enumerate().filter(|(_, block)| block.in_part()).find_map(|(i, block)| {
            let is_low = |var| matches!(var, Some(VarId::D | VarId::Vclear | VarId::Lastd));
            let words = &block.axis_words;
            words.iter().find(|(word, axis)| *axis == 2 && is_low(word.printed_var())).map(|(word, _)| (i, word))
        });
        let Some((down, word)) = down else { continue };
        // the axes of the plane that a block moves, as bits
        let across = |block: &Block| {
            let words = &block.axis_words;
            let words =
                words.iter().filter(|(word, axis)| *axis < 2 && word.printed_var().is_some() && block.in_part());
            words.fold(0, |set, (_, axis)| set | 1 << axis)
        };
        let before = blocks[..=down].iter().fold(0, |set, block| set | across(block));
        // before a tool change, the tool may be at any position
        let changes = [S::FirstToolChange, S::ToolChange].map(Purpose::Sequence).contains(&body.purpose);
        if changes && before != 0b11 && blocks[down + 1..].iter().all(|block| across(block) == 0) {
            diags.push(
                Diag::new(Code::PF416, format!("{} goes down without a position", body.name()))
                    .at(word.span, "the tool goes down at the tool change position")
                    .help("print `G0 X[h] Y[v]` before the depth"),
            );
            continue;
        }
        if let Some(late) = blocks[down + 1..].iter().find(|block| across(block) & !before != 0) {
            let there = late.line.span;
            diags.push(
                Diag::new(Code::PF416, format!("{} goes down before the tool is above the position", body.name()))
                    .at(word.span, "down here")
                    .at(there, "across here")
                    .help("print `X[h] Y[v]` first, the depth after it"),
            );
        }
    }
}

/// Whether the sequence is a canned cycle that prints single moves instead of a cycle of the control.
fn is_emulated(body: &Body, id: SequenceId) -> bool {
    id.row().is_cycle && !body.moves_by_itself()
}
