//! PF502: G4, G28, G53 and G92 act only in their own block. If postform leaves out one of these codes because it is
//! unchanged, the code has no effect.

use crate::control;
use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(statement) = view.command(CommandId::ModalGs) else { return };
    let codes = view.settings.codes();
    for arg in &statement.args {
        let code = arg.text.trim_start_matches(['G', 'g']).parse::<f64>();
        let meaning = code.ok().and_then(|code| control::Code::of(b'G', code)).and_then(|code| codes.meaning(code));
        if meaning.is_some_and(|meaning| meaning.group().is_none()) {
            diags.push(
                Diag::new(Code::PF502, format!("{} acts once", arg.text))
                    .at(arg.span, "a repeated code would not be printed, although the control needs it in each block")
                    .help("name only modal codes: G0 to G3, G17 to G19"),
            );
        }
    }
}
