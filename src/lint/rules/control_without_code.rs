//! PF607: a code that the form's control does not have. So far only Grbl's are known to be few.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::WordKind;

/// G codes of mills that Grbl refuses.
const NOT_GRBL: &[(f64, f64)] =
    &[(41.0, 42.0), (43.0, 43.0), (44.0, 44.0), (50.0, 52.0), (68.0, 69.0), (73.0, 76.0), (81.0, 89.0), (95.0, 99.0)];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_for(&["grbl"]) {
        return;
    }
    for word in view.words() {
        let refused = match word.kind {
            WordKind::Literal(b'G', _, code) => NOT_GRBL.iter().any(|(from, to)| (*from..=*to).contains(&code)),
            WordKind::Literal(b'M', _, code) => [6.0, 19.0, 29.0, 98.0, 99.0].contains(&code),
            WordKind::Var(b'G', var) => matches!(var, VarId::Retplane | VarId::Side | VarId::Speedtype),
            _ => false,
        };
        if refused {
            diags.push(
                Diag::new(Code::PF607, "grbl does not have this code")
                    .at(word.span, "refused")
                    .help("take it out: without a sequence postform prints the moves of a cycle itself"),
            );
        }
    }
}
