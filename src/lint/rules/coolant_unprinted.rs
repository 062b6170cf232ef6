//! PF712: the form defines a code for a kind of coolant, but its sequences always print the code of flood.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.printed().has(VarId::Cool) {
        return;
    }
    let [on, ..] = view.settings.coolant;
    let typed = |code: f64| view.words().find(|word| word.is_code(b'M', &[code]));
    let Some(flood) = typed(on) else { return };
    for kind in &view.settings.coolant_kinds {
        if typed(kind.on).is_none() {
            let (name, code) = (kind.kind.name(), kind.on);
            diags.push(
                Diag::new(Code::PF712, format!("no sequence prints M{code}, the coolant `{name}`"))
                    .at(flood.span, format!("turns flood on, but the job requests {name}"))
                    .help("write `M[cool]`: it is the code of the coolant of the job"),
            );
        }
    }
}
