//! PF110: a comment in marks that the control does not have: round brackets, or a semicolon.

use crate::control::Rules;
use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::syntax::PieceKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let [open, _] = &view.settings.comment;
    // on a Fanuc and its like a semicolon is how the end of a block is shown
    let ends_block = view.settings.control().rules() == Rules::Fanuc && open != ";" && view.settings.eob.is_empty();
    for piece in view.pieces() {
        let found = match &piece.kind {
            PieceKind::Note { .. } if open != "(" => Some((
                format!("comments of this form begin with `{open}`"),
                "the control reads this as a block",
                "take it out, or change the `Comment` command",
            )),
            PieceKind::Stray(text) if ends_block && text.starts_with(';') => Some((
                "`;` begins no comment on this control".to_owned(),
                "printed with what stands after it: there the control ends the block",
                "a remark of the form begins with ` #`; write a comment of the program in brackets, `(CHANGE)`, or after `;` where the form has `Comment ;`",
            )),
            _ => None,
        };
        if let Some((message, label, help)) = found {
            diags.push(Diag::new(Code::PF110, message).at(piece.span, label).help(help));
        }
    }
}
