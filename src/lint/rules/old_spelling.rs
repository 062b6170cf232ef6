//! PF204: `<h>` and `Rapid; G0` are how the first forms were written.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{Piece, PieceKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (tree, source) in view.checked.trees.iter().zip(&view.checked.files) {
        let text = source.text.as_bytes();
        for word in tree.words() {
            for piece in word.pieces.iter().flat_map(parts) {
                let PieceKind::Variable { name, .. } = &piece.kind else { continue };
                let (open, close) = (name.span.start.saturating_sub(1), name.span.end);
                if text.get(open as usize) == Some(&b'<') {
                    let edit = |at: u32, bracket: &str| (Span { start: at, end: at + 1, ..name.span }, bracket.to_owned());
                    diags.push(older(Span { start: open, end: close + 1, ..name.span }, format!("write `[{}]`", name.text))
                        .fix("write square brackets", true, vec![edit(open, "["), edit(close, "]")]));
                }
            }
        }
        for statement in tree.statements().chain(tree.sequences().map(|node| &node.name)) {
            let at = statement.name.span.end;
            if statement.name.text.starts_with(';') || text.get(at as usize) != Some(&b';') {
                continue;
            }
            let span = Span { start: at, end: at + 1, ..statement.name.span };
            let glued = text.get(at as usize + 1).is_some_and(|b| !b" \t\r\n".contains(b));
            diags.push(older(span, "write no `;` after the name".into())
                .fix("take the semicolon out", true, vec![(span, if glued { " " } else { "" }.into())]));
        }
    }
}

fn older(span: Span, help: String) -> Diag {
    Diag::new(Code::PF204, "an older spelling").at(span, "still read").help(help)
}

/// A piece and, if it is a comment, what is in it.
fn parts(piece: &Piece) -> Vec<&Piece> {
    match &piece.kind {
        PieceKind::Note { parts, .. } => parts.iter().collect(),
        _ => vec![piece],
    }
}
