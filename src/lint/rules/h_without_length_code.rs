//! PF426: H without G43 activates no length offset, so the tool goes too deep by its length.

use crate::control::{Meaning, ToolLength};
use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() || matches!(view.traits().tool_length, ToolLength::Register | ToolLength::None) {
        return; // on these controls H activates the offset without a code, or there are no length registers
    }
    for body in &view.bodies {
        let register = body
            .words()
            .find(|word| word.printed_var() == Some(VarId::Lcomp) && view.printed_letter(word) == Some(b'H'));
        if let (Some(word), None) =
            (register, body.meaning(|meaning| meaning.turns_length_on() || meaning == Meaning::LengthData))
        {
            diags.push(
                Diag::new(Code::PF426, format!("{} prints a length register without G43", body.name()))
                    .at(word.span, "the length offset does not change")
                    .help("print `G43` before it"),
            );
        }
    }
}
