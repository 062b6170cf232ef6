//! PF719: a kind of coolant has its own off code, but the sequences turn off coolant only with the code of flood.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.printed().has(VarId::Coolantoff) {
        return;
    }
    let [_, off, _] = view.settings.coolant;
    let typed = |code: f64| view.words().filter(move |word| word.is_code(b'M', &[code]));
    let Some(first) = typed(off).next() else { return };
    let own = |code: Option<f64>| code.filter(|code| *code != off && typed(*code).next().is_none());
    for kind in &view.settings.coolant_kinds {
        let Some(code) = own(kind.off) else { continue };
        let (name, edits) = (kind.kind.name(), typed(off).map(|word| (word.span, "M[coolantoff]".to_owned())));
        diags.push(
            Diag::new(Code::PF719, format!("no sequence prints M{code}, which turns off the coolant `{name}`"))
                .at(first.span, "turns off flood, but not this coolant")
                .help("write `M[coolantoff]`: it is the code that turns off the active coolant")
                .fix("turn off the active coolant", false, edits.collect()),
        );
    }
}
