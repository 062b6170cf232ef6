//! The changed words of a changed block.

use std::hash::{Hash, Hasher};
use std::ops::Range;

use similar::{Algorithm, DiffTag, capture_diff_slices};

use super::ignore::Ignore;
use super::key::{hasher, is_seen};
use crate::nc::{Kind, Token, tokens};

/// A word or comment of a block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Word {
    /// The bytes of the word in the line.
    pub span: Range<usize>,
    /// The letter of the word; 0 for anything else.
    pub letter: u8,
    /// The number after the letter, if any.
    pub value: Option<f64>,
    /// `false`: a decimal point is missing, and this is a difference.
    point: bool,
    /// A hash of the compared parts. Two different words have the same hash with a chance of 1 in 2^64.
    key: u64,
}

impl Word {
    /// Whether the compared parts of both words are equal.
    pub fn is(&self, other: &Word) -> bool {
        self.key == other.key
    }
}

/// The tokens of the compared words of a block. `true`: the token belongs to the same word as the token before it.
fn pieces(line: &[u8], ignore: &Ignore) -> impl Iterator<Item = (Token, bool)> {
    let mut open = false;
    let seen =
        tokens(line).filter(|token| !matches!(token.kind, Kind::Blank | Kind::LineEnd) && is_seen(token, ignore));
    seen.map(move |token| {
        let continues = matches!(token.kind, Kind::Symbol(_) | Kind::Number(_) | Kind::Name | Kind::Quoted);
        let continues = open && continues;
        open = continues || !matches!(token.kind, Kind::Word(..));
        (token, continues)
    })
}

fn letter_and_value(kind: Kind) -> (u8, Option<f64>) {
    match kind {
        Kind::Word(letter, number) => (letter, Some(number.value + 0.0)),
        Kind::Letter(letter) => (letter, None),
        _ => (0, None),
    }
}

/// Writes the letters of the compared words of a block to `list`.
pub(super) fn letters(line: &[u8], ignore: &Ignore, list: &mut Vec<u8>) {
    list.clear();
    list.extend(
        pieces(line, ignore).filter(|(_, continues)| !continues).map(|(token, _)| letter_and_value(token.kind).0),
    );
}

/// The compared words of a block.
pub(super) fn words(line: &[u8], ignore: &Ignore) -> Vec<Word> {
    let mut list: Vec<Word> = Vec::with_capacity(8);
    for (token, continues) in pieces(line, ignore) {
        let text = &line[token.start..token.end];
        if let Some(last) = list.last_mut().filter(|_| continues) {
            last.span.end = token.end;
            last.key = key_of(&(last.key, text));
            continue;
        }
        let (letter, value) = letter_and_value(token.kind);
        let number = if let Kind::Word(_, number) = token.kind { ignore.value(number) } else { None };
        let key = match number {
            Some(number) => key_of(&(letter, number)),
            None if ignore.case && letter != 0 => key_of(&text.to_ascii_uppercase()),
            None => key_of(&text),
        };
        let point = number.is_none_or(|(_, point)| point);
        list.push(Word { span: token.start..token.end, letter, value, point, key });
    }
    list
}

fn key_of(part: &impl Hash) -> u64 {
    let mut hasher = hasher();
    part.hash(&mut hasher);
    hasher.finish()
}

/// Whether two blocks are equal if their numbers may differ by `tolerance`.
pub(super) fn within(old: &[Word], new: &[Word], tolerance: f64) -> bool {
    old.len() == new.len()
        && old.iter().zip(new).all(|(a, b)| match (a.value, b.value) {
            (Some(x), Some(y)) => a.letter == b.letter && a.point == b.point && (x - y).abs() <= tolerance,
            _ => a.key == b.key,
        })
}

/// The number of common letters, divided by the number of letters of the longer block.
pub(super) fn likeness(old: &[u8], new: &[u8]) -> f64 {
    let mut has = [false; 256];
    new.iter().for_each(|letter| has[usize::from(*letter)] = true);
    let shared = old.iter().filter(|letter| has[usize::from(**letter)]).count();
    shared as f64 / old.len().max(new.len()).max(1) as f64
}

/// The byte ranges of changed words in an old and a new block.
pub fn changed_spans(old: &[u8], new: &[u8], ignore: &Ignore) -> [Vec<Range<usize>>; 2] {
    let (before, after) = (words(old, ignore), words(new, ignore));
    let keys = |list: &[Word]| -> Vec<u64> { list.iter().map(|word| word.key).collect() };
    let mut spans = [Vec::new(), Vec::new()];
    for op in capture_diff_slices(Algorithm::Myers, &keys(&before), &keys(&after)) {
        let (tag, from, to) = op.as_tag_tuple();
        if tag != DiffTag::Equal {
            spans[0].extend(before[from].iter().map(|word| word.span.clone()));
            spans[1].extend(after[to].iter().map(|word| word.span.clone()));
        }
    }
    spans
}
