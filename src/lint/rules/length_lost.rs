//! PF444: a sequence moves to the machine zero, where the control cancels the tool length offset, and does not activate
//! the offset again.

use crate::control::ToolLength;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::{Body, Purpose, View};
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let has_codes = matches!(view.traits().tool_length, ToolLength::CodeAndRegister | ToolLength::Code);
    if !view.is_mill() || view.is_flat() || !has_codes {
        return;
    }
    for body in view.bodies.iter().filter(|body| goes_on_with_its_tool(body, view)) {
        let Some(word) = ends_length(body, view) else { continue };
        let help = match body.purpose {
            Purpose::Sequence(SequenceId::MoveHome) => {
                "add the sequence AfterHome with `G0 X[h] Y[v]` and `G43 H[lcomp] Z[d]`"
            }
            _ => "print `G43 H[lcomp]` with the next height",
        };
        diags.push(
            Diag::new(Code::PF444, format!("{} ends the tool length and does not turn it on again", body.name()))
                .at(word.span, "this code ends the tool length on this control")
                .help(help),
        );
    }
}

/// Whether the same tool cuts after the sequence.
fn goes_on_with_its_tool(body: &Body, view: &View) -> bool {
    match body.purpose {
        Purpose::Upon(var, _) => var == VarId::Work,
        Purpose::Sequence(SequenceId::MoveHome) => view.body(SequenceId::AfterHome).is_none(),
        Purpose::Sequence(id) => matches!(id, SequenceId::WorkChange | SequenceId::Index | SequenceId::Unwind),
    }
}

/// Finds the code that cancels the tool length offset. `None` if a later word of the sequence activates the offset
/// again.
fn ends_length<'a>(body: &Body<'a>, view: &View) -> Option<&'a Word> {
    let mut ended = None;
    for line in body.lines {
        let turns_on = |word: &Word| {
            view.printed_letter(word) == Some(b'H')
                || view.meaning(word).is_some_and(|meaning| meaning.turns_length_on())
        };
        let goes_up = line.words.iter().any(|word| view.is_depth(word));
        let ends = |word: &&Word| match view.ends_length(word) {
            0 => false,
            0b100 => goes_up,
            _ => true,
        };
        ended = line.words.iter().find(ends).or(ended);
        if line.words.iter().any(turns_on) {
            ended = None;
        }
    }
    ended
}
