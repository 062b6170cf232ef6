//! PF205: `Xh` and `X(h)` are text. Probably `X[h]` was intended.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::syntax::{Piece, PieceKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for word in view.checked.trees.iter().flat_map(|tree| tree.words()) {
        for (i, piece) in word.pieces.iter().enumerate() {
            let PieceKind::Stray(text) = &piece.kind else { continue };
            let (span, letter, name) = match word.pieces.get(i + 1).map(|next| (&next.kind, next.span)) {
                // as in `X(h)`
                Some((PieceKind::Note { parts, closed: true }, end)) => match parts.as_ref() {
                    [Piece { kind: PieceKind::Stray(name), .. }] => (piece.span.to(end), text.as_str(), name.as_str()),
                    _ => continue,
                },
                Some(_) => continue,
                // as in `Xh` and `X{h}`
                None if text.is_char_boundary(1) => (piece.span, &text[..1], text[1..].trim_matches(['{', '}'])),
                None => continue,
            };
            let is_letter = letter.len() == 1 && letter.bytes().all(|b| b.is_ascii_uppercase());
            let meant = VarId::parse(name).filter(|_| is_letter && name.bytes().all(|b| !b.is_ascii_uppercase()));
            let Some(var) = meant else { continue };
            let better = format!("{letter}[{}]", var.name());
            diags.push(
                Diag::new(Code::PF205, "a variable without its brackets is printed as text")
                    .at(span, "printed as text")
                    .help(format!("write `{better}`"))
                    .fix("put the variable in brackets", false, vec![(span, better)]),
            );
        }
    }
}
