//! PF411: a cycle does not print its R plane, so the control goes at rapid to the R plane of the previous cycle.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() {
        return;
    }
    for (_, body) in view.hole_cycles() {
        let Some((word, code)) = body.cycle_word() else { continue };
        if !body.begins_with(&[VarId::Vclear, VarId::Rplane]) {
            diags.push(
                Diag::new(Code::PF411, format!("{code} has no R plane"))
                    .at(word.span, "the control would use the R plane of the cycle before")
                    .help("print the clearance plane, as `R[vclear]`"),
            );
        }
    }
}
