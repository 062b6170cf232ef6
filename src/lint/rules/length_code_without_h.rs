//! PF425: G43 without H takes no offset, or the last one.

use crate::diag::{Code, Diag};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.is_for(&["linuxcnc", "emc2", "grbl"]) {
        return; // G43 alone is the tool in the spindle; grbl has none of it
    }
    let lines = view.bodies.iter().flat_map(|body| body.lines.iter().map(move |line| (body, line)));
    for (body, line) in lines {
        let Some(word) = line.words.iter().find(|word| word.is_code(b'G', &[43.0, 44.0])) else { continue };
        if !line.words.iter().any(|word| view.printed_letter(word) == Some(b'H')) {
            diags.push(
                Diag::new(Code::PF425, format!("{} turns the length offset on and does not say which", body.name()))
                    .at(word.span, "no H")
                    .help("print the register, as `G43 H[lcomp]`"),
            );
        }
    }
}
