//! PF426: H alone turns no length offset on. The tool goes deeper than the part by its length.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() || view.is_for(&["fadal", "grbl"]) {
        return; // H alone is enough for a Fadal
    }
    for body in &view.bodies {
        let register = body
            .words()
            .find(|word| word.printed_var() == Some(VarId::Lcomp) && view.printed_letter(word) == Some(b'H'));
        if let (Some(word), None) = (register, body.code(b'G', &[43.0, 44.0, 43.1, 43.2, 43.4, 43.5])) {
            diags.push(
                Diag::new(Code::PF426, format!("{} prints a length register without G43", body.name()))
                    .at(word.span, "the offset stays as it was")
                    .help("print `G43` before it"),
            );
        }
    }
}
