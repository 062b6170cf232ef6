//! PF417: a cycle whose last move leaves the tool at the bottom: the way to the next hole is through the part.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::{View, cycle_word};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (sequence, body) in view.hole_cycles() {
        if cycle_word(&body).is_some() || !view.is_mill() || sequence.lines.len() < 2 {
            continue;
        }
        let blocks = view.blocks(body);
        let mut words = blocks.iter().rev().filter(|block| block.in_part()).flat_map(|block| block.axis_words(view));
        let last = words.find(|(_, axis)| *axis == 2);
        if let Some((word, _)) = last.filter(|(word, _)| word.printed_var() == Some(VarId::D)) {
            // codes of a control that nobody knows here may lift the tool
            let own_codes = body
                .words()
                .any(|word| word.typed(b'G').is_some_and(|code| code >= 100.0 || [33.1, 65.0, 66.0].contains(&code)));
            if !own_codes {
                diags.push(
                    Diag::new(Code::PF417, format!("{} ends at the bottom of the hole", body.name()))
                        .at(word.span, "the last depth that is printed")
                        .help("lift the tool in the last line: `G0 Z[rplane]`"),
                );
            }
        }
    }
}
