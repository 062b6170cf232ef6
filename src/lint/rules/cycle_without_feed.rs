//! PF412: a cycle does not print a feed, so the control drills with the last feed.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() {
        return;
    }
    for (_, body) in view.hole_cycles() {
        let Some((word, code)) = body.cycle_word() else { continue };
        if !body.begins_with(&[VarId::Frate, VarId::Plunge, VarId::Pitch]) {
            diags.push(
                Diag::new(Code::PF412, format!("{code} has no feed"))
                    .at(word.span, "the control would drill at the feed of the move before")
                    .help("print the feed of the cycle, as `F[frate]`"),
            );
        }
    }
}
