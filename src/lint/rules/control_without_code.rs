//! PF607: the form uses a code that its control does not have. Checked only for controls whose codes are all known.

use crate::control;
use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let (control, settings) = (view.settings.control(), view.settings);
    let refuses = |letter, value| control::Code::of(letter, value).is_some_and(|code| control.refuses(code));
    for word in view.words() {
        let refused = match word.kind {
            WordKind::Literal(letter @ (b'G' | b'M'), _, value) => refuses(letter, value),
            WordKind::Var(b'G', VarId::Retplane) => refuses(b'G', settings.return_plane[0]),
            WordKind::Var(b'G', VarId::Side) => refuses(b'G', settings.cdc[0]),
            WordKind::Var(b'G', VarId::Speedtype) => refuses(b'G', settings.speed_type[0]),
            _ => false,
        };
        if refused {
            diags.push(
                Diag::new(Code::PF607, format!("{} does not have this code", control.name()))
                    .at(word.span, "refused")
                    .help("remove the code; a cycle without a sequence is printed as moves"),
            );
        }
    }
}
