//! How a form says a work offset: by a G code, or by a word of its own, whose value may be calculated.

use super::letters::LetterTable;
use crate::control::{Code, Control, Group, Meaning};
use crate::lang::{SequenceId, VarId, VarSet};
use crate::sema::{Form, Formula, Line, Word, WordKind};

/// A work offset that is the parameter of a code, or a word of its own: `G154 P[work]`, `G15 H[work]`, `E[work]`.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkWord {
    /// The G code before it in its block.
    pub code: Option<Code>,
    /// The letter of the word.
    pub letter: u8,
    /// How the form makes its value, as `[work-53]`; `None`: it is the job's.
    pub calculated: Option<Formula>,
    /// G54 to G59 select offsets beside it. Not where its own code is another one: G56 of an Okuma, which has G15, is a
    /// length.
    pub shares_its_codes: bool,
}

/// The word of the work offset; `None`: a G code says it, or nothing. The tool changes know best.
pub(super) fn of(form: &Form) -> Option<WorkWord> {
    let letters = LetterTable::new(form, false);
    let changes = [SequenceId::FirstToolChange, SequenceId::ToolChange].iter().filter_map(|id| form.sequences.get(id));
    let upons = form.upons.iter().filter(|upon| upon.var == VarId::Work).map(|upon| &upon.lines);
    let others =
        form.sequences.values().map(|sequence| &sequence.lines).chain(form.upons.iter().map(|upon| &upon.lines));
    let lines = changes.map(|sequence| &sequence.lines).chain(upons).chain(others).flatten();
    let words: Vec<WorkWord> = lines.filter_map(|line| in_block(form.settings.codes(), line)).collect();
    let by_code = words.iter().any(|word| letters[word.letter].printed == b'G');
    words.into_iter().next().filter(|_| !by_code)
}

/// The word in one block, unless it is an argument there: of a macro, a subprogram, or of G10.
fn in_block(control: &Control, line: &Line) -> Option<WorkWord> {
    let own = line.words.iter().enumerate().find_map(|(at, word)| match &word.kind {
        WordKind::Var(letter, VarId::Work) => Some((at, *letter, None)),
        WordKind::Formula(Some(letter), of) if of.vars() == VarSet::of(&[VarId::Work]) => {
            Some((at, *letter, Some(Formula::clone(of))))
        }
        _ => None,
    });
    let (at, letter, calculated) = own?;
    let takes = |meaning: Meaning| meaning == Meaning::Data || meaning.is_call();
    if line.words.iter().filter_map(Word::code).any(|code| control.meaning(code).is_some_and(takes)) {
        return None;
    }
    let selects = |code: &Code| code.letter == b'G' && matches!(control.group(*code), None | Some(Group::Work));
    let code = line.words[..at].iter().rev().find_map(|word| word.code().or_else(|| quoted(word)).filter(selects));
    let shares_its_codes = code.is_none_or(|code| control.group(code) == Some(Group::Work));
    Some(WorkWord { code, letter, calculated, shares_its_codes })
}

/// A code in backquotes.
fn quoted(word: &Word) -> Option<Code> {
    let WordKind::Quote(text) = &word.kind else { return None };
    text.trim().parse().ok()
}
