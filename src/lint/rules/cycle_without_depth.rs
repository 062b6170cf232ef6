//! PF407: a cycle does not print the depth, so the control drills to the depth of the previous cycle.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() {
        return;
    }
    for (sequence, body) in view.hole_cycles() {
        if !body.begins_with(&[VarId::D, VarId::Depth, VarId::Inidep, VarId::Ddist]) {
            diags.push(
                Diag::new(Code::PF407, format!("{} does not print the depth", body.name()))
                    .at(sequence.span, "the control would use the depth of the cycle before")
                    .help("print the bottom of the hole, as `Z[d]`"),
            );
        }
    }
}
