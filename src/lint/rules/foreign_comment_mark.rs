//! PF110: a comment has marks that the control does not know: round brackets, or a semicolon.

use crate::control::Rules;
use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::syntax::PieceKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let [open, _] = &view.settings.comment;
    // Fanuc and similar controls display a semicolon as the end of a block
    let ends_block = view.settings.control().rules() == Rules::Fanuc && open != ";" && view.settings.eob.is_empty();
    for piece in view.pieces() {
        let found = match &piece.kind {
            PieceKind::Note { .. } if open != "(" => Some((
                format!("comments of this form begin with `{open}`"),
                "the control reads this comment as a block",
                "remove the comment, or change the `Comment` command",
            )),
            PieceKind::Stray(text) if ends_block && text.starts_with(';') => Some((
                "`;` does not begin a comment on this control".to_owned(),
                "printed with the text after it: the control ends the block at `;`",
                "a comment of the form begins with ` #`; write a comment of the program in brackets, `(CHANGE)`, or \
                 after `;` if the form has `Comment ;`",
            )),
            _ => None,
        };
        if let Some((message, label, help)) = found {
            diags.push(Diag::new(Code::PF110, message).at(piece.span, label).help(help));
        }
    }
}
