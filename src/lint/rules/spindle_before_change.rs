//! PF427: a spindle that is started before the tool changes.

use crate::control::{Kept, Meaning};
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::says_tool;
use crate::lint::view::{Body, View};
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (body, change) in changes(view) {
        let mut lines = body.lines[..change].iter().flat_map(|line| &line.words);
        if let Some(word) = lines.find(|word| starts_spindle(view, word)) {
            diags.push(
                Diag::new(Code::PF427, format!("{} starts the spindle before it changes the tool", body.name()))
                    .at(word.span, "the old tool turns")
                    .help("print the spindle after the tool change"),
            );
        } else if let Some(word) = stopped_again(view, &body) {
            diags.push(
                Diag::new(Code::PF427, format!("{} stops the spindle again after it is on", body.name()))
                    .at(word.span, "the tool stands still in the first cut")
                    .help("print the spindle behind it: `S[speed] M[direct]`"),
            );
        }
    }
}

/// A tool change or a stop of the program after the spindle was started, which nothing starts again. Some controls leave
/// it turning at a stop.
fn stopped_again<'a>(view: &View<'a>, body: &Body<'a>) -> Option<&'a Word> {
    let keeps = view.traits().spindle_at_stop == Kept::Yes;
    let stops = |word: &&Word| {
        let own = |meaning: Meaning| meaning == Meaning::SpindleOff || meaning.changes_tool();
        view.meaning(word).is_some_and(|meaning| own(meaning) || !keeps && meaning.is_stop())
    };
    let start = body.lines.iter().rposition(|line| line.words.iter().any(|word| starts_spindle(view, word)))?;
    body.lines[start + 1..].iter().flat_map(|line| &line.words).find(stops)
}

/// Does a word start the spindle?
pub(super) fn starts_spindle(view: &View, word: &Word) -> bool {
    view.meaning(word).is_some_and(Meaning::starts_spindle) || word.printed_vars().has(VarId::Direct)
}

/// The tool changes with the line in which the tool changes.
pub(super) fn changes<'a>(view: &View<'a>) -> Vec<(Body<'a>, usize)> {
    let line = |body: &Body, is: &dyn Fn(&Word) -> bool| body.lines.iter().position(|line| line.words.iter().any(is));
    let bodies = view.these(&[SequenceId::FirstToolChange, SequenceId::ToolChange]);
    bodies
        .filter_map(|body| {
            let change = line(&body, &|word| view.meaning(word).is_some_and(Meaning::changes_tool));
            Some((body, change.or_else(|| line(&body, &|word| says_tool(word)))?))
        })
        .collect()
}
