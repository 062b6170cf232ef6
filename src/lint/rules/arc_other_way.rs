//! PF432: CwCode prints the code of a counter-clockwise arc, or CcwCode prints the code of a clockwise arc.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let settings = view.settings;
    let table = [(SequenceId::CwCode, &settings.ccw, &settings.cw), (SequenceId::CcwCode, &settings.cw, &settings.ccw)];
    for (id, wrong, right) in table {
        let Some(body) = view.body(id).filter(|_| wrong.value() != right.value()) else { continue };
        let Some(word) = body.code(b'G', &[wrong.value()]) else { continue };
        let better = format!("G{}", right.value());
        diags.push(
            Diag::new(Code::PF432, format!("{} prints an arc in the opposite direction", body.name()))
                .at(word.span, "the opposite direction")
                .help(format!("write `{better}`"))
                .fix("turn the arc", false, vec![(word.span, better)]),
        );
    }
}
