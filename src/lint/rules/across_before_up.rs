//! PF441: at the end, and before a tool is changed, the tool goes up first. `G91 G0 Z0` goes nowhere.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::Block;
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
        let mut up = false;
        for block in view.blocks(body).iter().take_while(changes) {
            let height = block.axis_words.iter().find(|(_, axis)| *axis == 2);
            if let Some(what) = height.and_then(|(word, _)| does_not_lift(block, word))
                && let Some((word, _)) = height
            {
                diags.push(
                    Diag::new(Code::PF441, format!("{} does not lift the tool", body.name()))
                        .at(word.span, what)
                        .help("lift it to the reference point: `G91 G28 Z0` and `G90`; or in machine coordinates, `G0 G53 Z0`"),
                );
                break;
            }
            // where it goes up and across in one, somebody chose it
            up |= height.is_some();
            if let (false, Some((word, _))) = (up, block.axis_words.first()) {
                diags.push(
                    Diag::new(Code::PF441, format!("{} goes across before the tool is up", body.name()))
                        .at(word.span, "at the height of the last move")
                        .help("lift the tool first: `G91 G28 Z0` and `G90`, or `G0 G53 Z0`"),
                );
                break;
            }
        }
    }
}

/// What a typed height does under G91, if it lifts nothing.
fn does_not_lift(block: &Block, word: &Word) -> Option<&'static str> {
    let value = word.letter().and_then(|letter| word.typed(letter))?;
    match (block.incremental && !block.machine, block.reference) {
        (true, true) if value < 0.0 => Some("goes down by this on the way"),
        (true, false) if value < 0.0 => Some("goes down by this"),
        (true, false) if value == 0.0 => Some("an increment of nothing"),
        _ => None,
    }
}
