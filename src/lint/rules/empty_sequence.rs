//! PF012: a sequence without a line prints nothing, and what it stands for is lost with it.

use crate::diag::{Code, Diag};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in &view.bodies {
        if !body.lines.is_empty() || body.sequence.is_some_and(|sequence| sequence.is_none) {
            continue;
        }
        diags.push(
            Diag::new(Code::PF012, format!("{} has no lines", body.name()))
                .at(body.span, "nothing is printed where it is due")
                .help("write its lines, or take it out, so that postform prints what is needed; `None` says that nothing is wanted"),
        );
    }
}
