//! PF111: a comment contains another comment. Comments do not nest: the first closing mark ends the outer comment.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::syntax::PieceKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for piece in view.pieces() {
        let PieceKind::Note { parts, .. } = &piece.kind else { continue };
        let inner = parts.iter().find(|part| matches!(&part.kind, PieceKind::Stray(text) if text.contains('(')));
        if let Some(inner) = inner {
            diags.push(
                Diag::new(Code::PF111, "a comment inside a comment")
                    .at(inner.span, "the first `)` ends both comments")
                    .help("remove the inner brackets"),
            );
        }
    }
}
