//! PF106: a `#` begins a comment after a blank only; inside a word it is printed.

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
            Diag::new(Code::PF106, format!("`{text}` is printed as it stands"))
                .at(Span { start, ..piece.span }, "no comment: no blank is before it")
                .help("put a blank before the `#`")
                .fix(
                    "put a blank before the comment",
                    false,
                    vec![(Span { start, end: start, ..piece.span }, " ".into())],
                ),
        );
    }
}
