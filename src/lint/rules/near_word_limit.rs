//! PF605: a line has 14 or 15 words; the limit is 15.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::MOST_WORDS;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in view.written_lines() {
        let count = body.begins().count();
        if (MOST_WORDS - 1..=MOST_WORDS).contains(&count) {
            diags.push(
                Diag::new(Code::PF605, format!("the line has {count} words: the limit is {MOST_WORDS}"))
                    .at(body.line.span, "almost full")
                    .help("break the line in two before it reaches the limit"),
            );
        }
    }
}
