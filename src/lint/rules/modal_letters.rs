//! PF501: I, J, K, L and P have a meaning only in their own block, because no control keeps their values.

use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(statement) = view.command(CommandId::ModalLetters) else { return };
    for arg in &statement.args {
        let wrong: String = arg.text.chars().filter(|c| "IJKLP".contains(*c)).collect();
        if !wrong.is_empty() && arg.text.bytes().all(|b| b.is_ascii_alphabetic()) {
            diags.push(
                Diag::new(Code::PF501, format!("{wrong} is not modal on any control"))
                    .at(arg.span, "a repeated value would not be printed")
                    .help("name only axes, F and S"),
            );
        }
    }
}
