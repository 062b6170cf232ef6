//! PF435: RapidCode with G1 or a feed: every rapid would take the time of a cut.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(body) = view.body(SequenceId::RapidCode) else { return };
    let feed = view.settings.feed_code;
    let feeds = |word: &&Word| word.is_code(b'G', &[1.0, 2.0, 3.0]) || word.letter() == Some(feed);
    if let Some(word) = body.words().find(feeds) {
        diags.push(
            Diag::new(Code::PF435, "RapidCode feeds").at(word.span, "no rapid").help("print `G0 X[h] Y[v] Z[d]`"),
        );
    }
}
