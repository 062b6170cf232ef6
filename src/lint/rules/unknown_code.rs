//! PF608: a code is missing in the file of the form's control, so its effect is unknown.

use crate::control;
use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    // a form that names no control has no control file to check
    let Some(control) = view.settings.control.filter(|_| view.is_mill()) else { return };
    for word in view.words() {
        if let WordKind::Var(letter @ (b'G' | b'M'), var) = word.kind {
            let mut codes =
                view.settings.codes_of(var).into_iter().filter_map(|value| control::Code::of(letter, value));
            if let Some(code) = codes.find(|&code| control.lacks(code)) {
                let message = format!("[{}] may print {code}, which {} does not have", var.name(), control.name());
                diags.push(
                    Diag::new(Code::PF608, message)
                        .at(word.span, "a program with this code is not proven")
                        .help("set the codes of the machine with the command for this variable, or describe the code in the control file"),
                );
            }
        }
        let Some(code) = word.code() else { continue };
        let named = code.letter == b'G' && view.settings.names_code(code);
        if control.row(code).is_some() || control.refuses(code) || named {
            continue;
        }
        diags.push(
            Diag::new(Code::PF608, format!("{code} is unknown for {}", control.name()))
                .at(word.span, "all positions are printed again after this code, and no program is proven from here on")
                .help("describe it in a control file, as `\"G201\" = { is = \"harmless\" }`, or allow the finding"),
        );
    }
}
