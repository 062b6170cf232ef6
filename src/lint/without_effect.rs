//! PF203: commands of the original desktop product that do nothing here.

use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::sema::Checked;
use crate::syntax::Head;

pub fn check(checked: &Checked, diags: &mut Vec<Diag>) {
    for item in checked.trees.iter().flat_map(|tree| &tree.items) {
        let Head::Statement(statement) = item else { continue };
        if let Some(id @ (CommandId::Tools | CommandId::Drive | CommandId::WindowSize)) =
            CommandId::parse(&statement.name.text)
        {
            diags.push(
                Diag::new(Code::PF203, format!("{} has no effect", id.name()))
                    .at(statement.line.span, "of the original desktop product")
                    .help("it may stay or go"),
            );
        }
    }
}
