//! PF425: G43 without H activates no length offset, or the last length offset.

use crate::control::{Meaning, ToolLength};
use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if matches!(view.traits().tool_length, ToolLength::Code | ToolLength::None) {
        return; // on these controls G43 alone uses the tool in the spindle, or there are no length registers
    }
    let lines = view.bodies.iter().flat_map(|body| body.lines.iter().map(move |line| (body, line)));
    for (body, line) in lines {
        let Some(word) = line.words.iter().find(|word| view.meaning(word).is_some_and(Meaning::turns_length_on)) else {
            continue;
        };
        // the register may come from a macro variable, as `H#518`
        let by_macro = |word: &Word| matches!(&word.kind, WordKind::Text(text) if text.starts_with("H#"));
        if !line.words.iter().any(|word| view.printed_letter(word) == Some(b'H') || by_macro(word)) {
            diags.push(
                Diag::new(Code::PF425, format!("{} turns the length offset on without a register", body.name()))
                    .at(word.span, "no H")
                    .help("print the register, as `G43 H[lcomp]`"),
            );
        }
    }
}
