//! PF417: after the last move of a cycle, the tool is still at the bottom, so the move to the next hole goes through
//! the part.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (sequence, body) in view.hole_cycles() {
        // a code that the control's file does not contain may lift the tool
        if body.moves_by_itself() || !view.is_mill() || sequence.lines.len() < 2 {
            continue;
        }
        let last = view.blocks(body).iter().rev().find_map(|block| {
            let (word, _) = block.axis_words.iter().rev().find(|(_, axis)| *axis == 2)?;
            Some((word, block.in_part()))
        });
        if let Some((word, true)) = last.filter(|(word, _)| word.printed_var() == Some(VarId::D)) {
            diags.push(
                Diag::new(Code::PF417, format!("{} ends at the bottom of the hole", body.name()))
                    .at(word.span, "the last depth that is printed")
                    .help("lift the tool in the last line: `G0 Z[rplane]`"),
            );
        }
    }
}
