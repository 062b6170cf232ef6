//! PF107: a comment after a name begins with fewer than three spaces.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::Tail;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (tree, source) in view.checked.trees.iter().zip(&view.checked.files) {
        for node in tree.sequences() {
            let Tail::Lost(remark) = &node.name.line.tail else { continue };
            let before = &source.text[node.name.line.span.start as usize..remark.span.start as usize];
            let gap = before.len() - before.trim_end().len();
            let is_count = remark.text.trim_end().bytes().all(|b| b.is_ascii_digit()); // another rule reports a count
            if gap >= 3 || before.contains('\t') || is_count {
                continue;
            }
            let at = Span { start: remark.span.start, end: remark.span.start, ..remark.span };
            diags.push(
                Diag::new(Code::PF107, "the comment is too close to the name")
                    .at(remark.span, "the comment needs at least three spaces before it")
                    .help("write three spaces: two look like a typing mistake")
                    .fix("put another space before the comment", true, vec![(at, " ".repeat(3 - gap))]),
            );
        }
    }
}
