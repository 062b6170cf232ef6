//! How a form says a work offset: by a G code, or by a word of its own.

use super::letters::LetterTable;
use crate::lang::{Group, SequenceId, VarId, group_of};
use crate::sema::{Form, Line, WordKind};

/// A work offset that is the parameter of a code, or a word of its own: `G154 P[work]`, `G15 H[work]`, `E[work]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkWord {
    /// The G code before it in its block.
    pub code: Option<f64>,
    /// Its letter.
    pub letter: u8,
}

impl WorkWord {
    /// Do G54 to G59 select offsets beside it? Not where its own code is another one: G56 of an Okuma, which has G15, is a
    /// length.
    pub fn shares_its_codes(self) -> bool {
        self.code.is_none_or(|code| code >= 54.0)
    }
}

/// The word of the work offset; `None`: a G code says it, or nothing. The tool changes know best.
pub(super) fn of(form: &Form) -> Option<WorkWord> {
    let letters = LetterTable::new(form, false);
    let changes = [SequenceId::FirstToolChange, SequenceId::ToolChange].iter().filter_map(|id| form.sequences.get(id));
    let upons = form.upons.iter().filter(|upon| upon.var == VarId::Work).map(|upon| &upon.lines);
    let others =
        form.sequences.values().map(|sequence| &sequence.lines).chain(form.upons.iter().map(|upon| &upon.lines));
    let lines = changes.map(|sequence| &sequence.lines).chain(upons).chain(others).flatten();
    let words: Vec<WorkWord> = lines.filter_map(in_block).collect();
    let by_code = words.iter().any(|word| letters[word.letter].printed == b'G');
    words.first().copied().filter(|_| !by_code)
}

/// The word in one block, unless it is an argument there: of a macro, a subprogram, or of G10.
fn in_block(line: &Line) -> Option<WorkWord> {
    let at = line.words.iter().position(|word| matches!(word.kind, WordKind::Var(_, VarId::Work)))?;
    let called = |code: f64| [10.0, 65.0, 66.0].contains(&code);
    if line.words.iter().any(|word| word.typed(b'G').is_some_and(called) || word.is_code(b'M', &[97.0, 98.0])) {
        return None;
    }
    let selects = |code: &f64| matches!(group_of(b'G', (code * 10.0).round() as i64), None | Some(Group::Work));
    let code = line.words[..at].iter().rev().find_map(|word| word.typed(b'G').filter(selects));
    Some(WorkWord { code, letter: line.words[at].letter()? })
}
