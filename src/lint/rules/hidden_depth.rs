//! PF503: a cycle prints the depth relative to the hole's top. The relative depth is equal for holes at other heights,
//! so the cycle does not print the depth again.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() || view.settings.incremental {
        return;
    }
    for (_, body) in view.hole_cycles() {
        // a code that the control's file does not contain may need a relative depth
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
                    Diag::new(
                        Code::PF503,
                        format!(
                            "{} prints the depth of the hole, but the control needs the position of its bottom",
                            body.name()
                        ),
                    )
                    .at(word.span, "this depth is equal for holes at other heights, so it is not printed again")
                    .help("print the bottom of the hole, as `Z[d]`"),
                );
            }
        }
    }
}
