//! PF505: of two codes of one group a control takes the last, or alarms.

use crate::diag::{Code, Diag};
use crate::lang::{group_of, is_cycle_code};
use crate::lint::view::View;
use crate::sema::{Line, Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for line in view.bodies.iter().flat_map(|body| body.lines) {
        let codes = line.words.iter().filter_map(|word| match word.kind {
            // G80 with a motion code is common; with a cycle it ends that one
            WordKind::Literal(b'G', _, 80.0) if !starts_cycle(line) => None,
            WordKind::Literal(letter @ (b'G' | b'M'), _, value) => {
                Some((word, group_of(letter, (value * 10.0).round() as i64)?))
            }
            _ => None,
        });
        let codes: Vec<_> = codes.collect();
        for (i, (word, group)) in codes.iter().enumerate() {
            let Some((first, _)) = codes[..i].iter().find(|(_, other)| other == group) else { continue };
            let is_coolant = |word: &Word| word.is_code(b'M', &[7.0, 8.0]);
            if is_coolant(word) && is_coolant(first) {
                continue; // mist with flood is meant
            }
            diags.push(
                Diag::new(Code::PF505, "two codes of one group in a block")
                    .at(word.span, "excludes the other")
                    .at(first.span, "the other")
                    .help("keep one of them, or print two blocks"),
            );
        }
    }
}

fn starts_cycle(line: &Line) -> bool {
    line.words.iter().any(|word| word.typed(b'G').is_some_and(is_cycle_code))
}
