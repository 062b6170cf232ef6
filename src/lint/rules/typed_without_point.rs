//! PF309: on Fanuc and Haas `X1` is a ten-thousandth of an inch, or a micron.

use crate::diag::{Code, Diag};
use crate::lint::blocks::is_cycle_code;
use crate::lint::view::View;
use crate::sema::{Line, Word, WordKind};
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_for(&["fanuc", "haas"]) {
        return;
    }
    // in the block of a cycle K counts how often
    let repeats = |line: &Line, word: &Word| {
        word.letter() == Some(b'K') && line.words.iter().any(|word| word.typed(b'G').is_some_and(is_cycle_code))
    };
    let lines = view.bodies.iter().flat_map(|body| body.lines);
    for word in lines.flat_map(|line| line.words.iter().filter(|word| !repeats(line, word))) {
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
