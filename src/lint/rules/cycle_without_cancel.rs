//! PF409: a cycle of the control is never cancelled. The cycle stays active, so the next move would drill.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::Tail;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (sequence, body) in view.hole_cycles() {
        let Some((word, code)) = body.cycle_word() else { continue };
        let uncounted = sequence.count.is_none() && sequence.lines.len() > 1; // PF404 reports these sequences
        if view.works_once(code) || sequence.cancel.is_some() || uncounted || !body.leaves_cycle() {
            continue;
        }
        let mut diag = Diag::new(Code::PF409, format!("{} leaves {code} active", body.name()))
            .at(word.span, "the control would also make a hole at the next position")
            .help("end the cycle with `End Cancel`, and print G80 in a sequence `Cancel`");
        let end = view.node(sequence.span).and_then(|node| node.end.as_ref());
        if let Some(end) =
            end.filter(|end| view.body(SequenceId::Cancel).is_some() && !matches!(end.line.tail, Tail::Lost(_)))
        {
            let at = Span { start: end.word.end, ..end.word };
            diag = diag.fix("cancel the cycle", false, vec![(at, " Cancel".into())]);
        }
        diags.push(diag);
    }
}
