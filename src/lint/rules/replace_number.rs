//! PF312: Replace changes its text everywhere in the program, also inside numbers.

use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (id, statement) in view.commands() {
        let Some(old) = statement.args.first().filter(|_| id == CommandId::Replace) else { continue };
        let cuts = old.text.ends_with(|c: char| c.is_ascii_digit() || c == '.');
        let no_letter = !old.text.contains(|c: char| c.is_alphabetic() || c == '(' || c == ')' || c == '%');
        let no_letter = no_letter && old.text.contains(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        if !cuts && !no_letter {
            continue;
        }
        let example = if no_letter { format!("X1{}2", old.text) } else { format!("{}0", old.text) };
        diags.push(
            Diag::new(Code::PF312, format!("`{}` may be part of a longer word", old.text))
                .at(statement.line.span, format!("`{example}` would be changed, too"))
                .help("print the right word directly: in its sequence, or by the command of the code"),
        );
    }
}
