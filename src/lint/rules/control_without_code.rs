//! PF607: a code that the form's control does not have. So far only Grbl's are known to be few.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::WordKind;

/// The G codes of Grbl 1.1, by its own list of supported codes.
const G: &[f64] = &[
    0.0, 1.0, 2.0, 3.0, 4.0, 10.0, 17.0, 18.0, 19.0, 20.0, 21.0, 28.0, 28.1, 30.0, 30.1, 38.2, 38.3, 38.4, 38.5, 40.0,
    43.1, 49.0, 53.0, 54.0, 55.0, 56.0, 57.0, 58.0, 59.0, 61.0, 80.0, 90.0, 91.0, 91.1, 92.0, 92.1, 93.0, 94.0,
];

/// Its M codes.
const M: &[f64] = &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 8.0, 9.0, 30.0, 56.0];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_for(&["grbl"]) {
        return;
    }
    for word in view.words() {
        let refused = match word.kind {
            WordKind::Literal(b'G', _, code) => !G.contains(&code),
            WordKind::Literal(b'M', _, code) => !M.contains(&code),
            WordKind::Var(b'G', var) => matches!(var, VarId::Retplane | VarId::Side | VarId::Speedtype),
            _ => false,
        };
        if refused {
            diags.push(
                Diag::new(Code::PF607, "grbl does not have this code")
                    .at(word.span, "refused")
                    .help("take it out; a cycle without its sequence is printed as moves"),
            );
        }
    }
}
