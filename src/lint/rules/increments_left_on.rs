//! PF424: G91 is printed without a G90 after it, so the control reads all following positions as increments.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::{Purpose, View};
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let [incremental, absolute] = view.settings.inc_abs;
    let mode =
        |word: &&Word| word.is_code(b'G', &[incremental, absolute]) || word.printed_var() == Some(VarId::Incmode);
    // if StartCode sets the mode, the end of the previous program need not set it
    let begins = view.body(SequenceId::StartCode).is_some_and(|start| start.words().any(|word| mode(&word)));
    for body in view.bodies.iter().filter(|_| !view.settings.incremental) {
        if begins && body.purpose == Purpose::Sequence(SequenceId::EndCode) {
            continue;
        }
        let last = body.words().filter(mode).last();
        if let Some(word) = last.filter(|word| word.is_code(b'G', &[incremental])) {
            diags.push(
                Diag::new(Code::PF424, format!("{} leaves G{incremental} on", body.name()))
                    .at(word.span, "every later position is taken as an increment")
                    .help(format!("print `G{absolute}` after it")),
            );
        }
    }
}
