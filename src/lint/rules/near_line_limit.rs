//! PF606: the form has more than 135 lines; the limit is 150.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::MOST_LINES;
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let lines: Vec<Span> =
        view.written_lines().filter(|body| !body.words.is_empty()).map(|body| body.line.span).collect();
    if (MOST_LINES * 9 / 10 + 1..=MOST_LINES).contains(&lines.len()) {
        diags.push(
            Diag::new(Code::PF606, format!("the form has {} sequence lines: the limit is {MOST_LINES}", lines.len()))
                .at(lines[lines.len() - 1], "the last one")
                .help("take out sequences that are not used"),
        );
    }
}
