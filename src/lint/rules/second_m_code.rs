//! PF609: a block has two M codes, but the control allows only one.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.traits().one_m {
        return;
    }
    let is_m = |word: &&Word| matches!(word.kind, WordKind::Literal(b'M', ..) | WordKind::Var(b'M', _));
    for line in view.bodies.iter().flat_map(|body| body.lines) {
        let mut codes = line.words.iter().filter(is_m);
        let Some(first) = codes.next() else { continue };
        for word in codes {
            diags.push(
                Diag::new(Code::PF609, format!("{} takes one M code in a block", view.settings.control().name()))
                    .at(word.span, "one M code too many")
                    .at(first.span, "the first")
                    .help("print one of the M codes on a separate line"),
            );
        }
    }
}
