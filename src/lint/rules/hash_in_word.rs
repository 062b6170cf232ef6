//! PF106: a `#` inside a word is printed. A `#` begins a comment only if a space precedes it.

use crate::diag::{Code, Diag};
use crate::lint::tokens::looks_like_a_code;
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::PieceKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for piece in view.pieces() {
        let PieceKind::Stray(text) = &piece.kind else { continue };
        let Some(at) = text.find('#').filter(|&at| looks_like_a_code(&text[..at])) else { continue };
        let start = piece.span.start + at as u32;
        diags.push(
            Diag::new(Code::PF106, format!("`{text}` is printed as text"))
                .at(Span { start, ..piece.span }, "not a comment: there is no space before the `#`")
                .help("put a space before the `#`")
                .fix(
                    "put a space before the comment",
                    false,
                    vec![(Span { start, end: start, ..piece.span }, " ".into())],
                ),
        );
    }
}
