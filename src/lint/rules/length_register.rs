//! PF437: the length of a tool is not told to the control, or that of another one.

use crate::control::{Meaning, ToolLength};
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId, VarSet};
use crate::lint::view::{Purpose, View};
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() || view.traits().tool_length == ToolLength::None || view.is_flat() {
        return; // without registers the zero is that of the tool
    }
    let on = |word: &Word| {
        view.meaning(word).is_some_and(|meaning| meaning.turns_length_on() || meaning == Meaning::LengthData)
    };
    let is_register = |word: &&Word| view.printed_letter(word) == Some(b'H');
    let first = view.body(SequenceId::FirstToolChange).filter(|body| !body.lines.is_empty());
    // words of a conversational control have the length in their tool call
    let first = first.filter(|body| !body.words().any(|word| matches!(word.kind, WordKind::Text(_))));
    // what turns the part comes later, and only sometimes
    let later = [SequenceId::Index, SequenceId::Unwind].map(Purpose::Sequence);
    let mut words = view.bodies.iter().filter(|body| !later.contains(&body.purpose)).flat_map(|body| body.words());
    let says = words.any(|word| on(word) || is_register(&word));
    if let (Some(body), false) = (first, says) {
        let better = if view.traits().tool_length == ToolLength::Register { "H[lcomp]" } else { "G43 H[lcomp]" };
        diags.push(
            Diag::new(Code::PF437, "the program never says the length of a tool")
                .at(body.span, "every tool goes as deep as the spindle nose would")
                .help(format!("print `{better}` with the first depth of a tool")),
        );
    }
    for (body, word) in view.bodies.iter().filter_map(|body| Some((body, body.code(b'G', &[44.0])?))) {
        diags.push(
            Diag::new(Code::PF437, format!("{} takes the length of a tool off with G44", body.name()))
                .at(word.span, "lengths count upwards from the nose: the tool would go down by twice its length")
                .help("write `G43`"),
        );
    }
    for body in view.these(&[SequenceId::FirstToolChange, SequenceId::ToolChange]) {
        let own = |word: &Word| {
            word.printed_vars().meets(VarSet::of(&[VarId::Lcomp, VarId::Comp, VarId::Tool, VarId::Tool1]))
        };
        // a fixture's number, unless the block turns a length on
        let fixture = |word: &Word| {
            let words = &body.lines[body.line_of(word)].words;
            word.printed_vars().has(VarId::Work) && !words.iter().any(on)
        };
        // H0 takes the offset off
        let other = |word: &&Word| is_register(word) && !own(word) && !fixture(word) && word.typed(b'H') != Some(0.0);
        if let Some(word) = body.words().find(other) {
            diags.push(
                Diag::new(Code::PF437, format!("{} takes the length of another tool", body.name()))
                    .at(word.span, "not the length register of the tool")
                    .help("write `H[lcomp]`"),
            );
        }
    }
}
