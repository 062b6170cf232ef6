//! PF507: the start prints neither G90 nor G91, so the mode of the last program or of manual operation stays active.

use crate::control::Kept;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    // other controls begin each program in a defined mode
    if !view.is_mill() || view.settings.incremental || view.traits().modes_at_start != Kept::Yes {
        return;
    }
    let [_, positions] = view.settings.inc_abs;
    for body in view.these(&[S::StartCode, S::FirstToolChange]) {
        for block in view.blocks(body) {
            let words = &block.line.words;
            if words.iter().any(|word| word.is_code(b'G', &[positions]) || word.printed_var() == Some(VarId::Incmode)) {
                return;
            }
            let place = |var| matches!(var, Some(VarId::H | VarId::V | VarId::D));
            if let Some((word, _)) = block.axis_words.iter().find(|(word, _)| place(word.printed_var())) {
                diags.push(
                    Diag::new(Code::PF507, "the program goes to a position without G90")
                        .at(word.span, "if the previous program left G91 on, this position is an increment")
                        .help(format!("print `G{positions}` in StartCode")),
                );
                return;
            }
        }
    }
}
