//! PF503: a depth below its point is the same in a low hole as in a high one: the word does not change, and is dropped.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() || view.settings.incremental {
        return;
    }
    for (_, body) in view.hole_cycles() {
        // codes of a control that nobody knows here may want how deep
        let own_codes = body.cycle_word().is_none() && body.moves_by_itself();
        if own_codes {
            continue;
        }
        for block in view.blocks(body) {
            let words = &block.axis_words;
            let depth = words
                .iter()
                .find(|(word, axis)| *axis == 2 && matches!(word.printed_var(), Some(VarId::Depth | VarId::Inidep)));
            if let (Some((word, _)), false) = (depth, block.incremental) {
                diags.push(
                    Diag::new(Code::PF503, format!("{} prints how deep, the control wants where", body.name()))
                        .at(word.span, "the same at holes of other heights, so later ones drop it")
                        .help("print the bottom of the hole, as `Z[d]`"),
                );
            }
        }
    }
}
