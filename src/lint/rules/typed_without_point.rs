//! PF309: on Fanuc and Haas `X1` is a ten-thousandth of an inch, or a micron.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::WordKind;
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_for(&["fanuc", "haas"]) {
        return;
    }
    for word in view.words() {
        let WordKind::Literal(letter, text, value) = &word.kind else { continue };
        let printed = view.letters[*letter].printed;
        let is_length = view.axis(*letter).is_some() || view.is_rotary(*letter) || b"UVWIJKR".contains(&printed);
        if !is_length || *value == 0.0 || text.contains('.') {
            continue;
        }
        let end = Span { start: word.span.end, ..word.span };
        diags.push(
            Diag::new(Code::PF309, format!("`{text}` has no point"))
                .at(word.span, "the control counts its smallest unit")
                .help(format!("write `{text}.`"))
                .fix("write the point", false, vec![(end, ".".into())]),
        );
    }
}
