//! PF408: the count of a cycle is the number of lines that print only at the first hole. If only these lines print the
//! position, all holes are drilled at the position of the first hole.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::Line;

pub fn check<'a>(view: &View<'a>, diags: &mut Vec<Diag>) {
    for (sequence, body) in view.hole_cycles() {
        let Some(count) = sequence.count else { continue };
        let (once, every) = sequence.lines.split_at(count.min(sequence.lines.len()));
        let find = |lines: &'a [Line], var| {
            lines.iter().flat_map(|line| &line.words).find(|word| word.printed_var() == Some(var))
        };
        let swallowed =
            [VarId::H, VarId::V].into_iter().find_map(|var| find(once, var).filter(|_| find(every, var).is_none()));
        if let Some(first) = swallowed {
            diags.push(
                Diag::new(Code::PF408, format!("{} prints the position at the first hole only", body.name()))
                    .at(first.span, "printed once")
                    .at(sequence.span, format!("the first {count} lines are for the first hole"))
                    .help("print `X[h] Y[v]` in the repeated lines, or use a smaller count"),
            );
        }
    }
}
