//! PF204: `<h>`, `G<0>` and `Rapid; G0` are an old spelling.

use crate::diag::{Code, Diag};
use crate::lang::{CommandId, SequenceId, VarId};
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{Piece, PieceKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (tree, source) in view.checked.trees.iter().zip(&view.checked.files) {
        let text = source.text.as_bytes();
        for word in tree.words() {
            for piece in word.pieces.iter().flat_map(parts) {
                let (name, letter) = match &piece.kind {
                    PieceKind::Variable { name, .. } => (name, None),
                    PieceKind::Literal { letter, number } => (number, Some(char::from(*letter))),
                    _ => continue,
                };
                let (open, close) = (name.span.start.saturating_sub(1), name.span.end);
                if text.get(open as usize) != Some(&b'<') || letter.is_none() && VarId::parse(&name.text).is_none() {
                    continue;
                }
                let span = Span { start: open, end: close + 1, ..name.span };
                let edit = |at: u32, bracket: &str| (Span { start: at, end: at + 1, ..name.span }, bracket.to_owned());
                diags.push(match letter {
                    Some(letter) => older(span, format!("write `{letter}{}`", name.text)).fix(
                        "remove the brackets",
                        true,
                        vec![edit(open, ""), edit(close, "")],
                    ),
                    None => older(span, format!("write `[{}]`", name.text)).fix(
                        "write square brackets",
                        true,
                        vec![edit(open, "["), edit(close, "]")],
                    ),
                });
            }
        }
        for statement in tree.statements().chain(tree.sequences().map(|node| &node.name)) {
            let name = &statement.name;
            let known = CommandId::parse(&name.text).is_some() || SequenceId::parse(&name.text).is_some();
            let at = name.span.end as usize;
            // a semicolon directly before an argument may be the first character of the argument, so this semicolon is
            // kept
            let apart = text.get(at + 1).is_none_or(|b| b" \t\r\n".contains(b));
            if known && apart && text.get(at) == Some(&b';') {
                let span = Span { start: name.span.end, end: name.span.end + 1, ..name.span };
                diags.push(older(span, "write no `;` after the name".into()).fix(
                    "remove the semicolon",
                    true,
                    vec![(span, String::new())],
                ));
            }
        }
    }
}

fn older(span: Span, help: String) -> Diag {
    Diag::new(Code::PF204, "an older spelling").at(span, "still read").help(help)
}

/// A piece, or the pieces inside a comment.
fn parts(piece: &Piece) -> Vec<&Piece> {
    match &piece.kind {
        PieceKind::Note { parts, .. } => parts.iter().collect(),
        _ => vec![piece],
    }
}
