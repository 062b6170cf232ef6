//! PF406: a cycle that does not print the position drills every hole at one place.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() {
        return; // a lathe drills at its centre
    }
    for (sequence, body) in view.hole_cycles() {
        let missing = [VarId::H, VarId::V].into_iter().filter(|&var| !body.prints(var));
        let names = missing.map(|var| format!("[{}]", var.name())).collect::<Vec<_>>().join(" and ");
        if names.is_empty() {
            continue;
        }
        diags.push(
            Diag::new(Code::PF406, format!("{} does not print {names}", body.name()))
                .at(sequence.span, "the control would stay where it is for every hole")
                .help("print the position, as `X[h] Y[v]`"),
        );
    }
}
