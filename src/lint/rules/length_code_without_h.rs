//! PF425: G43 without H takes no offset, or the last one.

use crate::diag::{Code, Diag};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.is_for(&["linuxcnc", "emc2", "grbl"]) {
        return; // G43 alone is the tool in the spindle; grbl has none of it
    }
    for body in &view.bodies {
        let Some(word) = body.code(b'G', &[43.0, 44.0]) else { continue };
        if !body.words().any(|word| word.letter().is_some_and(|letter| view.letters[letter].printed == b'H')) {
            diags.push(
                Diag::new(Code::PF425, format!("{} turns the length offset on and does not say which", body.name()))
                    .at(word.span, "no H")
                    .help("print the register, as `G43 H[lcomp]`"),
            );
        }
    }
}
