//! PF105: a comment has no closing mark. postform adds the mark to the program, but the form should contain it.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{PieceKind, Tail};

use super::swallowed_words::swallowed;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.settings.comment[1] != ")" {
        return; // comments of this control need no closing mark, or another closing mark
    }
    // the closing mark may be in text that is not printed
    let lost = |tail: &Tail| match tail {
        Tail::Lost(_) => true,
        Tail::Comment(comment) => view.checked.files[comment.file as usize].slice(*comment).contains(')'),
        _ => false,
    };
    let whole = view.written_lines().filter(|body| !lost(&body.line.tail));
    for piece in whole.flat_map(|body| &body.words).flat_map(|word| &word.pieces) {
        let PieceKind::Note { parts, closed: false } = &piece.kind else { continue };
        if swallowed(parts).is_some() {
            continue;
        }
        let end = Span { start: piece.span.end, ..piece.span };
        let diag = Diag::new(Code::PF105, "the comment is not closed")
            .at(piece.span, "the comment ends with the line")
            .help("write `)` at its end; the output stays the same");
        // another form that calls this file may have other comment marks, so only the main file gets the fix
        let own = piece.span.file == 0;
        diags.push(if own { diag.fix("close the comment", true, vec![(end, ")".into())]) } else { diag });
    }
}
