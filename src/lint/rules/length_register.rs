//! PF437: the program activates no tool length offset, or the offset of another tool.

use crate::control::{Meaning, ToolLength};
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId, VarSet};
use crate::lint::view::{Purpose, View};
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() || view.traits().tool_length == ToolLength::None || view.is_flat() {
        return; // without length registers, the zero point already belongs to the tool
    }
    let on = |word: &Word| {
        view.meaning(word).is_some_and(|meaning| meaning.turns_length_on() || meaning == Meaning::LengthData)
    };
    let is_register = |word: &&Word| view.printed_letter(word) == Some(b'H');
    let first = view.body(SequenceId::FirstToolChange).filter(|body| !body.lines.is_empty());
    // the tool call of a conversational control sets the length
    let first = first.filter(|body| !body.words().any(|word| matches!(word.kind, WordKind::Text(_))));
    // these sequences come after the first move, and not in every job
    let later = [SequenceId::Index, SequenceId::Unwind, SequenceId::AfterHome].map(Purpose::Sequence);
    let is_later = |purpose: &Purpose| later.contains(purpose) || matches!(purpose, Purpose::Upon(VarId::Work, _));
    let mut words = view.bodies.iter().filter(|body| !is_later(&body.purpose)).flat_map(|body| body.words());
    let says = words.any(|word| on(word) || is_register(&word));
    if let (Some(body), false) = (first, says) {
        let better = if view.traits().tool_length == ToolLength::Register { "H[lcomp]" } else { "G43 H[lcomp]" };
        diags.push(
            Diag::new(Code::PF437, "the program never turns a tool length offset on")
                .at(body.span, "without the offset the spindle nose goes to the position of the tool tip")
                .help(format!("print `{better}` with the first depth of a tool")),
        );
    }
    for (body, word) in
        view.bodies.iter().filter_map(|body| Some((body, body.meaning(|meaning| meaning == Meaning::LengthMinus)?)))
    {
        diags.push(
            Diag::new(Code::PF437, format!("{} subtracts the tool length with G44", body.name()))
                .at(word.span, "lengths count upwards from the nose: the tool would go down by twice its length")
                .help("write `G43`"),
        );
    }
    for body in view.these(&[SequenceId::FirstToolChange, SequenceId::ToolChange]) {
        let own = |word: &Word| {
            word.printed_vars().meets(VarSet::of(&[VarId::Lcomp, VarId::Comp, VarId::Tool, VarId::Tool1]))
        };
        // the word may be a fixture number, unless its block activates a length offset
        let fixture = |word: &Word| {
            let words = &body.lines[body.line_of(word)].words;
            word.printed_vars().has(VarId::Work) && !words.iter().any(on)
        };
        // H0 turns the offset off
        let other = |word: &&Word| is_register(word) && !own(word) && !fixture(word) && word.typed(b'H') != Some(0.0);
        if let Some(word) = body.words().find(other) {
            diags.push(
                Diag::new(Code::PF437, format!("{} uses the length of another tool", body.name()))
                    .at(word.span, "not the length register of the tool")
                    .help("write `H[lcomp]`"),
            );
        }
    }
}
