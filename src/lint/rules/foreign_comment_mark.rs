//! PF110: a comment in round brackets, on a control that has other marks.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::syntax::PieceKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let [open, _] = &view.settings.comment;
    if open == "(" {
        return;
    }
    for piece in view.pieces() {
        if matches!(piece.kind, PieceKind::Note { .. }) {
            diags.push(
                Diag::new(Code::PF110, format!("comments of this form begin with `{open}`"))
                    .at(piece.span, "the control reads this as a block")
                    .help("take it out, or change the `Comment` command"),
            );
        }
    }
}
