//! PF014: the program prints no end code, so the control continues with the next program in its memory.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(end) = view.body(SequenceId::EndCode) else { return };
    if end.meaning(|meaning| matches!(meaning, Meaning::End | Meaning::Return)).is_none() {
        diags.push(
            Diag::new(Code::PF014, "EndCode does not end the program")
                .at(end.span, "no M30, M2 or M99")
                .help("print `M30` in its last line"),
        );
    }
}
