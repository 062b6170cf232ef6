//! Finds the words with which a form prints its work offset.

use std::ops::Range;

use super::program::{Op, Program};
use super::work::{MoreWords, WorkWord, WorkWords};
use crate::control::{Code, Group, Meaning};
use crate::lang::{SequenceId, VarId, VarSet};
use crate::nc::{Kind, tokens};

/// A word that may select the work offset.
struct Found {
    op: usize,
    word: WorkWord,
    /// Rank of the word. 0: a code, or a parameter of a code that selects offsets. 1: a word without a code. 2: a value
    /// after a text. Only the words with the lowest rank in the form are used.
    rank: u8,
}

/// Finds the words for work offsets in a form. The words in tool changes come first.
pub(super) fn find_work(program: &Program) -> WorkWords {
    let is_line = |at: usize| program.ops.get(at).is_none_or(|op| matches!(op, Op::Line { .. }));
    let mut found = Vec::new();
    let mut begin = 0;
    for at in (1..=program.ops.len()).filter(|at| is_line(*at)) {
        in_block(begin..at, program, &mut found);
        begin = at;
    }
    let Some(best) = found.iter().map(|found| found.rank).min() else { return WorkWords::default() };
    found.retain(|found| found.rank == best);
    let changes =
        [SequenceId::FirstToolChange, SequenceId::ToolChange].into_iter().filter_map(|id| program.routine(id));
    let changes: Vec<Range<usize>> = changes.map(|routine| routine.ops.clone()).collect();
    let upons = program.upons.iter().filter(|upon| upon.var == VarId::Work);
    let upons: Vec<Range<usize>> = upons.map(|upon| upon.routine.ops.clone()).collect();
    let lies_in = |parts: &[Range<usize>], op: usize| parts.iter().any(|part| part.contains(&op));
    found.sort_by_key(|found| match found.op {
        op if lies_in(&changes, op) => 0,
        op if lies_in(&upons, op) => 1,
        _ => 2,
    });
    if best == OF_ITS_OWN {
        let letter = found[0].word.letter;
        found.retain(|found| found.word.letter == letter);
    }
    let mut words = WorkWords { says: found.iter().map(|found| found.op).collect(), ..WorkWords::default() };
    words.says.sort_unstable();
    for Found { word, .. } in found {
        if !words.ways.contains(&word) {
            words.ways.push(word);
        }
    }
    if words.by_code() {
        words.more = more_words(program);
    }
    let control = program.settings.codes();
    let shares = |way: &WorkWord| way.code.is_none_or(|code| control.group(code) == Some(Group::Work));
    words.shares_its_codes = words.ways.iter().all(shares);
    words
}

/// The work offsets that `MoreWork` defines.
fn more_words(program: &Program) -> Vec<MoreWords> {
    let first = program.settings.work;
    let more = program.settings.more_work.iter().map(|more| {
        let is_code = more.code.is_none() && program.letters[0][more.letter].printed == b'G';
        let word = WorkWord { code: more.code, letter: Some(more.letter), is_code, calculated: None };
        MoreWords { from: first + f64::from(more.first) - 1.0, word, number: more.number, last: more.last }
    });
    more.collect()
}

const BY_CODE: u8 = 0;
const OF_ITS_OWN: u8 = 1;
const BEHIND_TEXT: u8 = 2;

/// Finds the words in one block that may select the work offset. Words that are arguments of another code are ignored.
fn in_block(block: Range<usize>, program: &Program, found: &mut Vec<Found>) {
    let control = program.settings.codes();
    let own = VarSet::of(&[VarId::Work]);
    let formula = |index: u32| Some(&program.formulas[index as usize]).filter(|formula| formula.vars() == own).cloned();
    let mut codes: Vec<Code> = Vec::new();
    let begins = found.len();
    for op in block {
        let (letter, calculated) = match program.ops[op] {
            Op::Literal { index, .. } => {
                codes.extend(program.literals[index as usize].code);
                continue;
            }
            Op::Quote { index, .. } => {
                codes.extend(tokens(program.texts[index as usize].as_bytes()).filter_map(|token| match token.kind {
                    Kind::Word(letter, number) => Code::of(letter, number.value),
                    _ => None,
                }));
                continue;
            }
            Op::Var { letter, var: VarId::Work, .. } => (Some(letter), None),
            Op::Value { var: VarId::Work, .. } => (None, None),
            Op::Formula { letter, index, .. } if formula(index).is_some() => (Some(letter), formula(index)),
            Op::ValueFormula { index, .. } if formula(index).is_some() => (None, formula(index)),
            _ => continue,
        };
        let is_code = letter.is_some_and(|letter| program.letters[0][letter].printed == b'G');
        let selects = |code: &&Code| code.letter == b'G' && matches!(control.group(**code), None | Some(Group::Work));
        let code = codes.iter().rev().find(selects).copied().filter(|_| !is_code && letter.is_some());
        let rank = match (letter, code) {
            (None, _) => BEHIND_TEXT,
            _ if is_code => BY_CODE,
            (_, Some(code)) if control.group(code) == Some(Group::Work) => BY_CODE,
            _ => OF_ITS_OWN,
        };
        found.push(Found { op, word: WorkWord { code, letter, is_code, calculated }, rank });
    }
    let takes = |meaning: Meaning| meaning == Meaning::Data || meaning.is_call();
    if codes.iter().any(|code| control.meaning(*code).is_some_and(takes)) {
        found.truncate(begins);
    }
}
