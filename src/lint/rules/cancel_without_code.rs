//! PF410: Cancel prints no G80, so the sequence does not end the cycle.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(cancel) = view.body(SequenceId::Cancel) else { return };
    // on most controls a motion code also ends a cycle
    if cancel.meaning(Meaning::ends_cycle).is_none() {
        diags.push(
            Diag::new(Code::PF410, "Cancel does not end the cycle").at(cancel.span, "no G80").help("print `G80` in it"),
        );
    }
}
