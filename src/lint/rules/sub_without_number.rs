//! PF018: a subprogram call does not print the number of its subprogram, so the control calls another subprogram or
//! none.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in view.these(&[SequenceId::SubStart, SequenceId::SubCall]) {
        if !body.prints_any(&[VarId::Sub, VarId::Subline]) {
            diags.push(
                Diag::new(Code::PF018, format!("{} does not print the subprogram number", body.name()))
                    .at(body.span, "[sub] is not printed")
                    .help("print `O[sub]` in SubStart and `P[sub]` in SubCall"),
            );
        }
    }
}
