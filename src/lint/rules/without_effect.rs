//! PF203: commands of the original desktop product that do nothing here.

use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (id, statement) in view.commands() {
        if !matches!(id, CommandId::Tools | CommandId::Drive | CommandId::WindowSize) {
            continue;
        }
        diags.push(
            Diag::new(Code::PF203, format!("{} has no effect", id.name()))
                .at(statement.line.span, "of the original desktop product")
                .help("it may stay or go")
                .fix("take the line out", true, vec![(statement.line.span, String::new())]),
        );
    }
}
