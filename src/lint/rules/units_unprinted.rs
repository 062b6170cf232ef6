//! PF316: a form for both units whose programs do not say which.

use crate::diag::{Code, Diag};
use crate::lang::{CommandId, UnitChoice, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(units) = view.command(CommandId::Units).filter(|_| view.settings.units == UnitChoice::Both) else {
        return;
    };
    if !view.printed().has(VarId::Unitmode) {
        diags.push(
            Diag::new(Code::PF316, "the program never says its units")
                .at(units.line.span, "jobs in inches and in millimetres look alike")
                .help("print `G[unitmode]` in StartCode"),
        );
    }
}
