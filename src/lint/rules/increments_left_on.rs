//! PF424: every move after a G91 that was not taken back is an increment.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let [incremental, absolute] = view.settings.inc_abs;
    for body in view.bodies.iter().filter(|_| !view.settings.incremental) {
        let last = body.words().filter(|word| word.is_code(b'G', &[incremental, absolute])).last();
        let back = body.words().any(|word| word.printed_var() == Some(VarId::Incmode));
        if let Some(word) = last.filter(|word| word.is_code(b'G', &[incremental]) && !back) {
            diags.push(
                Diag::new(Code::PF424, format!("{} leaves G{incremental} on", body.name()))
                    .at(word.span, "every position after this is taken as an increment")
                    .help(format!("print `G{absolute}` behind it")),
            );
        }
    }
}
