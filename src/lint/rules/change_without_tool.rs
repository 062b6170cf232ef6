//! PF429: a tool change that does not say which tool, or only gets it ready.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in view.these(&[SequenceId::FirstToolChange, SequenceId::ToolChange]) {
        let says = |word: &Word| word.var() == Some(VarId::Tool) || word.letter() == Some(b'T');
        let Some(word) = body.words().find(|word| says(word)) else {
            if !body.lines.is_empty() {
                diags.push(
                    Diag::new(Code::PF429, format!("{} does not say which tool", body.name()))
                        .at(body.span, "no T")
                        .help("print `T[tool] M6`; where a person changes it, say which in a comment: `(TOOL [tool])`"),
                );
            }
            continue;
        };
        // a control that changes by itself wants M6; where a person does, the tool stands in a comment
        let selects = word.letter() == Some(b'T') && view.is_mill();
        if selects && body.code(b'M', &[6.0]).is_none() {
            diags.push(
                Diag::new(Code::PF429, format!("{} selects a tool and does not change it", body.name()))
                    .at(word.span, "no M6")
                    .help("print `M6` behind it"),
            );
        }
    }
}
