//! PF413: a peck cycle without its peck goes down in one.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in view.cycles_for(&[SequenceId::Peck, SequenceId::Chipbreak]) {
        let Some((word, code)) = body.cycle_word() else { continue };
        if !body.prints_any(&[VarId::Vbite, VarId::Peck1, VarId::Inidep, VarId::Sbite]) {
            diags.push(
                Diag::new(Code::PF413, format!("G{code} has no peck"))
                    .at(word.span, "the control would go down in one, or by the peck of the cycle before")
                    .help("print the peck, as `Q[vbite]`"),
            );
        }
    }
}
