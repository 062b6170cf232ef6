//! PF608: a code is missing in the file of the form's control, so its effect is unknown.

use crate::diag::{Code, Diag};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    // a form that names no control has no control file to check
    let Some(control) = view.settings.control.filter(|_| view.is_mill()) else { return };
    for word in view.words() {
        let Some(code) = word.code() else { continue };
        let named = code.letter == b'G' && view.settings.names_code(code);
        if control.row(code).is_some() || control.refuses(code) || named {
            continue;
        }
        diags.push(
            Diag::new(Code::PF608, format!("{code} is unknown for {}", control.name()))
                .at(word.span, "all positions are printed again after it, and no program is proven from here")
                .help("describe it in a control file, as `\"G201\" = { is = \"harmless\" }`, or allow the finding"),
        );
    }
}
