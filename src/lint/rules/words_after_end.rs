//! PF015: EndCode prints words after the end of the program, which the control ignores.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(end) = view.body(SequenceId::EndCode) else { return };
    // a control stops reading at `%` and stops executing at M30
    let is_end = |word: &Word| {
        matches!(view.meaning(word), Some(Meaning::End | Meaning::Return))
            || matches!(&word.kind, WordKind::Text(text) if text == "%")
    };
    let Some(last) = end.lines.iter().position(|line| line.words.iter().any(is_end)) else { return };
    let is_word = |word: &&Word| match &word.kind {
        WordKind::Text(text) => text != "%",
        WordKind::Note(_) | WordKind::Remark(_) => false,
        // text like `END PGM SLOT MM` is not a block
        WordKind::Quote(_) | WordKind::TextVar(_) => false,
        _ => true,
    };
    if let Some(word) = end.lines[last + 1..].iter().flat_map(|line| &line.words).find(is_word) {
        diags.push(
            Diag::new(Code::PF015, "a word after the end of the program")
                .at(word.span, "never done")
                .help("print M30 last, and after it only the `%`"),
        );
    }
}
