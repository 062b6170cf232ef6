//! PF429: a tool change does not print the tool number, or only preselects the tool.

use crate::control::{self, Meaning};
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, TextId, VarId};
use crate::lint::blocks::{calls, says_tool};
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.is_flat() {
        return; // torches and lasers have no tool change
    }
    let control = view.settings.control();
    for body in view.these(&[SequenceId::FirstToolChange, SequenceId::ToolChange]) {
        let printed = body.words().find(|word| says_tool(word));
        let Some(word) = printed else {
            // for a manual tool change, a comment with the tool's name is sufficient
            let named = |kind: &WordKind| match kind {
                WordKind::TextVar(text) | WordKind::RemarkText(text) => text.id == TextId::Toolname,
                _ => false,
            };
            let told = body.words().any(|word| word.var() == Some(VarId::Tool) || named(&word.kind));
            if !body.lines.is_empty() && !told {
                let typed = body.words().find(|word| view.printed_letter(word) == Some(b'T'));
                diags.push(
                    Diag::new(Code::PF429, format!("{} does not print the tool number", body.name()))
                        .at(typed.map_or(body.span, |word| word.span), "prints the same for every tool of a job")
                        .help(
                            "print `T[tool] M6`; for a manual tool change, print the tool in a comment: `(TOOL \
                            [tool])`",
                        ),
                );
            }
            continue;
        };
        let selects =
            view.printed_letter(word) == Some(b'T') && view.is_mill() && !control.refuses(control::Code::m(6));
        // a macro or a code of the machine's builder may change the tool, as `G65 P9020 T[tool]` or `G100 T[tool]`
        let by_macro = body.lines[body.line_of(word)].words.iter().any(|word| calls(view.settings.codes(), word));
        if selects && !by_macro && body.meaning(Meaning::changes_tool).is_none() {
            diags.push(
                Diag::new(Code::PF429, format!("{} selects a tool, but does not change it", body.name()))
                    .at(word.span, "no M6")
                    .help("print `M6` after it"),
            );
        }
    }
}
