//! PF431: an arc sequence that prints neither centre nor radius.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use VarId as V;
    for body in view.these(&[SequenceId::CwCode, SequenceId::CcwCode]) {
        let relative = [V::Ival, V::Jval, V::Kval].into_iter().filter(|&var| body.prints(var)).count();
        let absolute = [V::Hctr, V::Vctr].into_iter().filter(|&var| body.prints(var)).count();
        if body.lines.is_empty() || relative.max(absolute) >= 2 || body.prints(V::Arcrad) {
            continue;
        }
        diags.push(
            Diag::new(Code::PF431, format!("{} does not print the whole centre", body.name()))
                .at(body.span, "the control can't know the arc")
                .help("print `I[ival] J[jval]`, or `R[arcrad]`"),
        );
    }
}
