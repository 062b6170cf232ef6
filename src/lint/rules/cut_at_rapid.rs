//! PF436: LineCode, an arc sequence, InFeed or OutFeed prints no motion code, or the wrong motion code. The cut is made
//! with the motion of the previous move, in the worst case at rapid.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use Meaning as M;
    let moves = |meaning| matches!(meaning, M::Rapid | M::Line | M::ArcCw | M::ArcCcw);
    let table: [(SequenceId, &[Meaning], &str); 5] = [
        (SequenceId::LineCode, &[M::Rapid, M::ArcCw, M::ArcCcw], "G1"),
        (SequenceId::CwCode, &[M::Rapid, M::Line], "G2"),
        (SequenceId::CcwCode, &[M::Rapid, M::Line], "G3"),
        (SequenceId::InFeed, &[M::Rapid], "G1"),
        (SequenceId::OutFeed, &[M::Rapid], "G1"),
    ];
    for (id, wrong, right) in table {
        let Some(body) = view.body(id) else { continue };
        // text of a conversational control may contain the motion
        let says =
            body.words().any(|word| view.meaning(word).is_some_and(moves) || matches!(word.kind, WordKind::Text(_)));
        let (span, message) = match body.meaning(|meaning| wrong.contains(&meaning)) {
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
