//! PF406: a cycle does not print the position, so the control drills every hole at the same position.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::{Line, Word};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() {
        return; // a lathe drills on its axis
    }
    for (sequence, body) in view.hole_cycles() {
        let missing = [VarId::H, VarId::V].into_iter().filter(|&var| !body.prints(var));
        let names = missing.map(|var| format!("[{}]", var.name())).collect::<Vec<_>>().join(" and ");
        if names.is_empty() {
            // with K0 or L0 the cycle does not drill at its start; a cycle code without a depth only selects the cycle
            let waits = |word: &Word| word.is_code(b'K', &[0.0]) || word.is_code(b'L', &[0.0]);
            let drills = |line: &&Line| {
                let words = &line.words;
                let depth = words.iter().any(|word| view.is_depth(word));
                words.iter().any(|word| view.starts_cycle(word)) && depth && !words.iter().any(waits)
            };
            let cycle = body.cycle_word().filter(|_| body.lines.iter().any(|line| drills(&line)));
            let placed = body.begins_with(&[VarId::H]) && body.begins_with(&[VarId::V]);
            if let (Some((word, code)), false) = (cycle, placed) {
                diags.push(
                    Diag::new(Code::PF406, format!("{} starts {code} without the position", body.name()))
                        .at(word.span, "drills at the position of the tool, and drills the first hole twice")
                        .help("print `X[h] Y[v]` in the block of the cycle"),
                );
            }
            continue;
        }
        diags.push(
            Diag::new(Code::PF406, format!("{} does not print {names}", body.name()))
                .at(sequence.span, "the control would drill every hole at the same position")
                .help("print the position, as `X[h] Y[v]`"),
        );
    }
}
