//! PF502: G4, G28, G53 and G92 act in their block only: dropped, they do nothing.

use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::lint::view::View;

/// Codes that act once.
const ONCE: &[f64] = &[4.0, 5.1, 9.0, 10.0, 27.0, 28.0, 29.0, 30.0, 31.0, 50.0, 52.0, 53.0, 60.0, 65.0, 92.0];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(statement) = view.command(CommandId::ModalGs) else { return };
    for arg in &statement.args {
        let code = arg.text.trim_start_matches(['G', 'g']).parse::<f64>();
        if code.is_ok_and(|code| ONCE.contains(&code)) {
            diags.push(
                Diag::new(Code::PF502, format!("{} acts once", arg.text))
                    .at(arg.span, "the second one would be dropped, and be missed")
                    .help("name codes that stay in force only: G0 to G3, G17 to G19"),
            );
        }
    }
}
