//! PF316: a form accepts jobs in inches and in millimetres, but its programs print no unit code.

use crate::diag::{Code, Diag};
use crate::lang::{CommandId, UnitChoice, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(units) = view.command(CommandId::Units).filter(|_| view.settings.units == UnitChoice::Both) else {
        return;
    };
    if !view.printed().has(VarId::Unitmode) {
        diags.push(
            Diag::new(Code::PF316, "the program has no unit code")
                .at(units.line.span, "programs in inches and in millimetres look the same")
                .help("print `G[unitmode]` in StartCode"),
        );
    }
}
