//! PF408: the lines that a count sets apart are printed once; a position among them is that of the first hole.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (sequence, body) in view.hole_cycles() {
        let Some(count) = sequence.count else { continue };
        let position = |word: &&Word| matches!(word.printed_var(), Some(VarId::H | VarId::V));
        let (once, every) = sequence.lines.split_at(count.min(sequence.lines.len()));
        let first = once.iter().flat_map(|line| &line.words).find(position);
        let again = every.iter().flat_map(|line| &line.words).any(|word| position(&word));
        if let (Some(first), false) = (first, again) {
            diags.push(
                Diag::new(Code::PF408, format!("{} prints the position at the first hole only", body.name()))
                    .at(first.span, "printed once")
                    .at(sequence.span, format!("the first {count} lines are for the first hole"))
                    .help("print `X[h] Y[v]` in the lines that are repeated, or take a smaller count"),
            );
        }
    }
}
