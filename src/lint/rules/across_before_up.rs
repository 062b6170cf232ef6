//! PF441: at the end and before a tool change, the tool must first move up. `G91 G0 Z0` does not move the tool.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::blocks::{Block, calls, says_tool};
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() || view.is_flat() {
        return;
    }
    for body in view.these(&[SequenceId::ToolChange, SequenceId::EndCode]) {
        let blocks: Vec<&Block> = view.blocks(body).iter().take_while(|block| is_said(view, block)).collect();
        let lifts = blocks.iter().position(|block| height(block).is_some_and(|word| no_lift(block, word).is_none()));
        let fault = blocks[..lifts.unwrap_or(blocks.len())].iter().find_map(|block| {
            let no_lift = height(block).and_then(|word| Some((word, no_lift(block, word)?)));
            match (no_lift, block.axis_words.first()) {
                (Some((_, NOTHING)), _) if lifts.is_some() => None,
                (Some((word, what)), _) => Some((word, "does not lift the tool", what)),
                (None, Some((word, _))) => {
                    Some((*word, "moves across before the tool retracts", "at the height of the last move"))
                }
                (None, None) => None,
            }
        });
        if let Some((word, how, what)) = fault {
            diags.push(Diag::new(Code::PF441, format!("{} {how}", body.name())).at(word.span, what).help(
                "retract first: to the reference point, `G91 G28 Z0` and `G90`; or in machine coordinates, `G0 G53 \
                 Z0`",
            ));
        }
    }
}

/// Whether the block itself contains the target of its move. Blocks without a target are: a tool change (which retracts
/// by itself), a macro, a code of the machine's builder, and a return of all axes to home.
fn is_said(view: &View, block: &Block) -> bool {
    let leaves = |word: &Word| {
        calls(view.settings.codes(), word) || view.meaning(word).is_some_and(Meaning::changes_tool) || says_tool(word)
    };
    !(block.line.words.iter().any(leaves) || block.reference && block.axis_words.is_empty())
}

/// The word of the depth axis.
fn height<'a>(block: &Block<'a>) -> Option<&'a Word> {
    block.axis_words.iter().find(|(_, axis)| *axis == 2).map(|(word, _)| *word)
}

/// The description of `G91 G0 Z0` in the message.
const NOTHING: &str = "an increment of 0";

/// The reason why a height that is a number in the form does not lift the tool under G91. `None` if the tool is lifted,
/// or if the height is not a number.
fn no_lift(block: &Block, word: &Word) -> Option<&'static str> {
    let value = word.letter().and_then(|letter| word.typed(letter))?;
    match (block.incremental && !block.machine, block.reference) {
        (true, true) if value < 0.0 => Some("this increment goes down before the move to the reference point"),
        (true, false) if value < 0.0 => Some("this increment goes down"),
        (true, false) if value == 0.0 => Some(NOTHING),
        _ => None,
    }
}
