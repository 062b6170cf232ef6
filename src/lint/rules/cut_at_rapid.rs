//! PF436: LineCode and the arc sequences print cuts; with another motion code the cut is made otherwise, at worst at rapid.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let table: [(SequenceId, &[f64], &str); 3] = [
        (SequenceId::LineCode, &[0.0, 2.0, 3.0], "G1"),
        (SequenceId::CwCode, &[0.0, 1.0], "G2"),
        (SequenceId::CcwCode, &[0.0, 1.0], "G3"),
    ];
    for (id, wrong, right) in table {
        let Some(body) = view.body(id) else { continue };
        let Some(word) = body.code(b'G', wrong) else { continue };
        diags.push(
            Diag::new(Code::PF436, format!("{} prints a cut with another motion code", body.name()))
                .at(word.span, format!("{right} belongs here"))
                .help(format!("write `{right}`")),
        );
    }
}
