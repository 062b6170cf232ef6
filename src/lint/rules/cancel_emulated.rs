//! PF403: `End Cancel` in an emulated cycle has no effect, because no cycle of the control is active in an emulated
//! cycle.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for sequence in view.form.sequences.values().filter(|sequence| sequence.id.makes_holes()) {
        let Some(cancel) = sequence.cancel else { continue };
        let emulated = sequence.lines.len() > 1 && sequence.count.is_none();
        // a code with which the control moves by itself needs a Cancel
        let starts_cycle = view.body(sequence.id).is_some_and(|body| body.moves_by_itself());
        if (emulated && !starts_cycle) || sequence.is_none {
            let gap = Span { start: cancel.start - 1, ..cancel };
            diags.push(
                Diag::new(Code::PF403, format!("{} is emulated, so Cancel is never printed", sequence.id.name()))
                    .at(cancel, "this has no effect")
                    .help(
                        "write `End` alone; or give the cycle a count, if its first lines start a cycle of the control",
                    )
                    .fix("take Cancel out", true, vec![(gap, String::new())]),
            );
        }
    }
}
