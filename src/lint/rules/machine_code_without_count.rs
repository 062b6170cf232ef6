//! PF404: a cycle of the control in a sequence of several lines would drill each hole again with every line.

use crate::diag::{Code, Diag};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (sequence, body) in view.hole_cycles() {
        let Some((word, code)) = body.cycle_word() else { continue };
        if sequence.count.is_some() || sequence.lines.len() < 2 || body.code(b'G', &[80.0]).is_some() {
            continue;
        }
        diags.push(
            Diag::new(Code::PF404, format!("{} starts a cycle of the control and has no count", body.name()))
                .at(word.span, format!("G{code} drills again at each of the lines below it"))
                .at(sequence.span, "all lines are printed at every hole")
                .help(format!("write `{} 1`, if the first line is for the first hole only", body.name())),
        );
    }
}
