//! PF435: RapidCode prints G1 or a feed, so every rapid is made at feed.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(body) = view.body(SequenceId::RapidCode) else { return };
    let feed = view.settings.feed_code;
    let feeds = |word: &&Word| {
        matches!(view.meaning(word), Some(Meaning::Line | Meaning::ArcCw | Meaning::ArcCcw))
            || word.letter() == Some(feed)
    };
    let says = |word: &Word| view.meaning(word) == Some(Meaning::Rapid) || matches!(word.kind, WordKind::Text(_));
    let (span, label) = match (body.words().find(feeds), body.lines.first()) {
        (Some(word), _) => (word.span, "no rapid"),
        (None, Some(line)) if !body.words().any(says) => (line.span, "no G0: after a cut this move is at feed"),
        _ => return,
    };
    diags.push(Diag::new(Code::PF435, "RapidCode feeds").at(span, label).help("print `G0 X[h] Y[v] Z[d]`"));
}
