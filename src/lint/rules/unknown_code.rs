//! PF608: a code that the file of the form's control does not know. What it does is unknown to everybody.

use crate::diag::{Code, Diag};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    // where the form names no control there is none to ask
    let Some(control) = view.settings.control.filter(|_| view.is_mill()) else { return };
    for word in view.words() {
        let Some(code) = word.code() else { continue };
        let named = code.letter == b'G' && view.settings.names_code(code);
        if control.row(code).is_some() || control.refuses(code) || named {
            continue;
        }
        diags.push(
            Diag::new(Code::PF608, format!("{} has no {code} that we know", control.name()))
                .at(word.span, "after it all positions are said again, and no program is proven from here")
                .help("describe it in a control file, as `\"G201\" = { is = \"harmless\" }`, or allow it"),
        );
    }
}
