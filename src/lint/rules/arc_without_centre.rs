//! PF431: an arc sequence does not print the radius, and lacks at least one of the two centre words. postform then
//! prints lines instead of arcs.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use VarId as V;
    for body in view.these(&[SequenceId::CwCode, SequenceId::CcwCode]) {
        // centre words for both axes of the XY plane, where most arcs are
        let centre = [[V::Ival, V::Hctr], [V::Jval, V::Vctr]].iter().all(|vars| body.prints_any(vars));
        if body.lines.is_empty() || centre || body.prints(V::Arcrad) {
            continue;
        }
        // on a lathe the first axis is Z, whose centre word is K
        let letter = |axis: usize| match view.settings.axes[axis] {
            b'X' => 'I',
            b'Z' => 'K',
            _ => 'J',
        };
        let better = format!("{}[ival] {}[jval]", letter(0), letter(1));
        diags.push(
            Diag::new(Code::PF431, format!("{} does not print the whole centre", body.name()))
                .at(body.span, "postform prints lines instead of arcs")
                .help(format!("print `{better}`, or `R[arcrad]`")),
        );
    }
}
