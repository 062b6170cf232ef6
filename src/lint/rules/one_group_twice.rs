//! PF505: of two codes of one group a control takes the last, or alarms.

use crate::diag::{Code, Diag};
use crate::lang::{Group, group_of, is_cycle_code};
use crate::lint::view::View;
use crate::sema::{Line, Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for line in view.bodies.iter().flat_map(|body| body.lines) {
        let in_cycle = starts_cycle(line);
        // the first code of each group
        let mut firsts: Vec<(&Word, Group)> = Vec::new();
        for word in &line.words {
            let group = match word.kind {
                // G80 with a motion code is common; with a cycle it ends that one
                WordKind::Literal(b'G', _, 80.0) if !in_cycle => None,
                WordKind::Literal(letter @ (b'G' | b'M'), _, value) => group_of(letter, (value * 10.0).round() as i64),
                _ => None,
            };
            let Some(group) = group else { continue };
            let Some(&(first, _)) = firsts.iter().find(|(_, other)| *other == group) else {
                firsts.push((word, group));
                continue;
            };
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
