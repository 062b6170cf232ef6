//! PF715: CommentLine prints the comments of the job, but it does not contain `[text]`, so all comments are lost.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, TextId};
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(body) = view.body(SequenceId::CommentLine) else { return };
    let says = body.words().any(|word| match word.kind {
        WordKind::TextVar(text) | WordKind::RemarkText(text) => text.id == TextId::Text,
        _ => false,
    });
    if !says {
        diags.push(
            Diag::new(Code::PF715, "CommentLine does not print the comment")
                .at(body.span, "every comment of the job is lost")
                .help("print it: `([text])`"),
        );
    }
}
