//! PF104: a comment is not closed, so the words after it are part of the comment and have no effect.

use crate::diag::{Code, Diag};
use crate::lint::tokens::looks_like_a_code;
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{Piece, PieceKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for piece in view.pieces() {
        let PieceKind::Note { parts, closed: false } = &piece.kind else { continue };
        if let Some(at) = swallowed(parts) {
            diags.push(
                Diag::new(Code::PF104, "the comment contains words of the block")
                    .at(at, "from here on, the words are text")
                    .at(piece.span, "this comment is not closed")
                    .help("close the comment before the words, or put them on a line of their own"),
            );
        }
    }
}

/// Finds in a comment the first piece of text that looks like a word of a block.
pub(super) fn swallowed(parts: &[Piece]) -> Option<Span> {
    parts.iter().enumerate().find_map(|(i, part)| match &part.kind {
        PieceKind::Stray(text) => {
            let mut at = part.span.start as usize;
            let mut found = None;
            for token in text.split(' ') {
                // a single letter directly before a variable counts as a word
                let last = at + token.len() == part.span.end as usize;
                let before =
                    last && parts.get(i + 1).is_some_and(|next| matches!(next.kind, PieceKind::Variable { .. }));
                let is_letter = token.len() == 1 && b"XYZABCIJKRFSHDGM".contains(&token.as_bytes()[0]);
                if looks_like_a_code(token) || (before && is_letter) {
                    found.get_or_insert(Span::new(part.span.file, at, at + token.len()));
                }
                at += token.len() + 1;
            }
            found
        }
        _ => None,
    })
}
