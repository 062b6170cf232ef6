//! PF441: at the end, and before a tool is changed, the tool goes up first. `G91 G0 Z0` goes nowhere.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::{Block, moves_by_itself};
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() || view.is_flat() {
        return;
    }
    for body in view.these(&[SequenceId::ToolChange, SequenceId::EndCode]) {
        // M6 takes the tool up, or the machine could not change it
        let changes = |block: &&Block| {
            let words = &block.line.words;
            !words.iter().any(|word| word.is_code(b'M', &[6.0]) || word.printed_var() == Some(VarId::Tool))
        };
        // a macro, a code of the builder, and all axes home: where they go is not said here
        let blocks = view.blocks(body).iter().take_while(changes).take_while(|block| {
            let called = |word: &Word| word.typed(b'G').is_some_and(|code| code >= 65.0 && moves_by_itself(code));
            let calls = block.line.words.iter().any(|word| called(word) || word.is_code(b'M', &[97.0, 98.0]));
            !(calls || block.reference && block.axis_words.is_empty())
        });
        let mut nothing = None;
        for block in blocks {
            let height = block.axis_words.iter().find(|(_, axis)| *axis == 2).map(|(word, _)| *word);
            match height.and_then(|word| Some((word, does_not_lift(block, word)?))) {
                Some((word, what)) if what != NOTHING => {
                    nothing = Some((word, what));
                    break;
                }
                Some((word, what)) => nothing = Some((word, what)),
                // where it goes up and across in one, somebody chose it
                None if height.is_some() => {
                    nothing = None;
                    break;
                }
                None => {}
            }
            if let (None, Some((word, _))) = (nothing, block.axis_words.first()) {
                diags.push(
                    Diag::new(Code::PF441, format!("{} goes across before the tool is up", body.name()))
                        .at(word.span, "at the height of the last move")
                        .help("lift the tool first: `G91 G28 Z0` and `G90`, or `G0 G53 Z0`"),
                );
                break;
            }
        }
        if let Some((word, what)) = nothing {
            diags.push(
                Diag::new(Code::PF441, format!("{} does not lift the tool", body.name())).at(word.span, what).help(
                    "lift it to the reference point: `G91 G28 Z0` and `G90`; or in machine coordinates, `G0 G53 Z0`",
                ),
            );
        }
    }
}

/// What `G91 G0 Z0` does.
const NOTHING: &str = "an increment of nothing";

/// What a typed height does under G91, if it lifts nothing.
fn does_not_lift(block: &Block, word: &Word) -> Option<&'static str> {
    let value = word.letter().and_then(|letter| word.typed(letter))?;
    match (block.incremental && !block.machine, block.reference) {
        (true, true) if value < 0.0 => Some("goes down by this on the way"),
        (true, false) if value < 0.0 => Some("goes down by this"),
        (true, false) if value == 0.0 => Some(NOTHING),
        _ => None,
    }
}
