//! PF436: LineCode, the arc sequences and the moves of compensation print cuts; without their motion code the cut is made as
//! the move before it was, with another one otherwise: at worst at rapid.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::sema::WordKind;

/// The codes that say how the tool moves.
const MOTION: &[f64] = &[0.0, 1.0, 2.0, 3.0];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let table: [(SequenceId, &[f64], &str); 5] = [
        (SequenceId::LineCode, &[0.0, 2.0, 3.0], "G1"),
        (SequenceId::CwCode, &[0.0, 1.0], "G2"),
        (SequenceId::CcwCode, &[0.0, 1.0], "G3"),
        (SequenceId::InFeed, &[0.0], "G1"),
        (SequenceId::OutFeed, &[0.0], "G1"),
    ];
    for (id, wrong, right) in table {
        let Some(body) = view.body(id) else { continue };
        // words of a conversational control say how it moves
        let says = body.words().any(|word| word.is_code(b'G', MOTION) || matches!(word.kind, WordKind::Text(_)));
        let (span, message) = match body.code(b'G', wrong) {
            Some(word) => (word.span, "with another motion code"),
            None if !says && !body.lines.is_empty() => (body.lines[0].span, "without its motion code"),
            None => continue,
        };
        diags.push(
            Diag::new(Code::PF436, format!("{} prints a cut {message}", body.name()))
                .at(span, format!("{right} belongs here"))
                .help(format!("write `{right}`")),
        );
    }
}
