//! PF404: a cycle of the control in a sequence of several lines would drill each hole again with every line.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for sequence in view.form.sequences.values() {
        let threads = matches!(sequence.id, SequenceId::AutoThread | SequenceId::CanThread);
        if !sequence.id.row().is_cycle || threads || sequence.count.is_some() || sequence.lines.len() < 2 {
            continue;
        }
        for word in sequence.lines.iter().flat_map(|line| &line.words) {
            let WordKind::Literal(b'G', text, code) = &word.kind else { continue };
            if !is_machine_cycle(*code) {
                continue;
            }
            diags.push(
                Diag::new(
                    Code::PF404,
                    format!("{} starts a cycle of the control and has no count", sequence.id.name()),
                )
                .at(word.span, format!("{text} drills again at each of the lines below it"))
                .at(sequence.span, "all lines are printed at every hole")
                .help(format!("write `{} 1`, if the first line is for the first hole only", sequence.id.name())),
            );
            break;
        }
    }
}

/// G73, G74, G76 and G81 to G89.
fn is_machine_cycle(code: f64) -> bool {
    [73.0, 74.0, 76.0].contains(&code) || (81.0..90.0).contains(&code)
}
