//! PF102: `Z[d]F[plunge]` prints two words. A space between two words shows the reader where the second word begins.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for word in view.written() {
        for pair in word.pieces.windows(2) {
            if !pair[1].lacks_blank_after(&pair[0]) {
                continue;
            }
            let at = pair[1].span;
            diags.push(
                Diag::new(Code::PF102, "a space is missing between two words")
                    .at(at, "a new word begins here")
                    .help("put one space before the word; the output stays the same")
                    .fix("put a space between the words", true, vec![(Span { end: at.start, ..at }, " ".into())]),
            );
        }
    }
}
