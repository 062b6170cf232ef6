//! PF413: a peck cycle does not print its step, so the control drills to the bottom in one stroke.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in view.cycles_for(&[SequenceId::Peck, SequenceId::Chipbreak]) {
        let Some((word, code)) = body.cycle_word() else { continue };
        if !body.prints_any(&[VarId::Vbite, VarId::Peck1, VarId::Inidep, VarId::Sbite]) {
            let typed = body.words().find(|word| word.typed(b'Q').is_some_and(|peck| peck > 0.0));
            let (at, message, what) = match typed {
                Some(peck) => (peck, "a typed peck", "cycles with a peck in the job are printed as single moves"),
                None => {
                    (word, "no peck", "the control would drill in one stroke, or with the peck of the cycle before")
                }
            };
            diags.push(
                Diag::new(Code::PF413, format!("{code} has {message}"))
                    .at(at.span, what)
                    .help("print the peck of the job, as `Q[vbite]`"),
            );
        }
    }
}
