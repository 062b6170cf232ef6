//! PF505: a block has two codes of one group. The control uses the last of the two codes, or stops with an alarm.

use crate::control::{Group, Meaning};
use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for line in view.bodies.iter().flat_map(|body| body.lines) {
        let in_cycle = line.words.iter().any(|word| view.starts_cycle(word));
        // the first code of each group
        let mut firsts: Vec<(&Word, Group)> = Vec::new();
        for word in &line.words {
            let group = match word.kind {
                // G80 in a block with a motion code is common; in a block with a cycle code, G80 ends the cycle
                WordKind::Literal(..) if !in_cycle && view.meaning(word) == Some(Meaning::CycleEnd) => None,
                WordKind::Literal(..) => view.meaning(word).and_then(Meaning::group),
                _ => None,
            };
            let Some(group) = group else { continue };
            let Some(&(first, _)) = firsts.iter().find(|(_, other)| *other == group) else {
                firsts.push((word, group));
                continue;
            };
            let is_coolant = |word: &Word| matches!(view.meaning(word), Some(Meaning::Mist | Meaning::Flood));
            if is_coolant(word) && is_coolant(first) {
                continue; // mist and flood together are allowed
            }
            diags.push(
                Diag::new(Code::PF505, "two codes of one group in a block")
                    .at(word.span, "excludes the other code")
                    .at(first.span, "the other")
                    .help("keep one of them, or print two blocks"),
            );
        }
    }
}
