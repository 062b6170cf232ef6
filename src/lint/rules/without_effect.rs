//! PF203: a command of the original desktop product has no effect in postform.

use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::Tail;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (id, statement) in view.commands() {
        // another finding reports a missing argument
        let lacks = statement.args.is_empty();
        if lacks || !matches!(id, CommandId::Tools | CommandId::Drive | CommandId::WindowSize) {
            continue;
        }
        let line = &statement.line;
        let end = if let Tail::Comment(comment) = line.tail { comment.start } else { line.span.end };
        diags.push(
            Diag::new(Code::PF203, format!("{} has no effect", id.name()))
                .at(statement.line.span, "a command of the original desktop product")
                .help("you may keep or remove the command")
                .fix("remove the line", true, vec![(Span { end, ..line.span }, String::new())]),
        );
    }
}
