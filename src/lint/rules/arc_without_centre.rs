//! PF431: an arc sequence that prints neither centre nor radius.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use VarId as V;
    for body in view.these(&[SequenceId::CwCode, SequenceId::CcwCode]) {
        if body.lines.is_empty() || body.prints_any(&[V::Ival, V::Jval, V::Kval, V::Arcrad, V::Hctr, V::Vctr]) {
            continue;
        }
        diags.push(
            Diag::new(Code::PF431, format!("{} prints no centre", body.name()))
                .at(body.span, "the control can't know the arc")
                .help("print `I[ival] J[jval]`, or `R[arcrad]`"),
        );
    }
}
