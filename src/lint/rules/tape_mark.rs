//! PF016: a program begins with `%` but does not end with it. The control waits for the second `%`.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let mark = |id| {
        let body = view.body(id)?;
        let is_mark = |word: &&Word| matches!(&word.kind, WordKind::Text(text) if text == "%");
        Some((body.span, body.words().find(is_mark).map(|word| word.span)))
    };
    let (Some((start, first)), Some((end, last))) = (mark(SequenceId::StartCode), mark(SequenceId::EndCode)) else {
        return;
    };
    let (missing, name, there) = match (first, last) {
        (Some(there), None) => (end, "EndCode", there),
        (None, Some(there)) => (start, "StartCode", there),
        _ => return,
    };
    diags.push(
        Diag::new(Code::PF016, format!("{name} prints no `%`"))
            .at(missing, "one mark is missing")
            .at(there, "the other one")
            .help("print `%0` first in StartCode and last in EndCode, or in neither"),
    );
}
