//! The changes, counted by kind.

use std::collections::BTreeMap;

use super::align::{Comparison, Edit};
use super::ignore::Ignore;
use super::program::Program;
use super::words::{Word, words};

/// The numbers of changes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Blocks changed, removed, added, moved.
    pub changed: usize,
    #[allow(missing_docs)]
    pub removed: usize,
    #[allow(missing_docs)]
    pub added: usize,
    #[allow(missing_docs)]
    pub moved: usize,
    /// Number of changed blocks in which the number of a letter changed, by letter.
    pub letters: BTreeMap<char, usize>,
    /// Codes and words that were added to changed blocks, and those that were removed from them.
    pub more: BTreeMap<String, usize>,
    #[allow(missing_docs)]
    pub less: BTreeMap<String, usize>,
}

impl Summary {
    /// Counts a comparison.
    pub fn of(comparison: &Comparison, old: &Program, new: &Program, ignore: &Ignore) -> Summary {
        let mut summary = Summary::default();
        let mut moved = 0;
        for edit in comparison.edits() {
            match *edit {
                Edit::Removed(_) => summary.removed += 1,
                Edit::Added(_) => summary.added += 1,
                Edit::Moved(..) => moved += 1,
                Edit::Changed(a, b) => {
                    summary.changed += 1;
                    summary.block(&words(old.line(a), ignore), old.line(a), &words(new.line(b), ignore), new.line(b));
                }
            }
        }
        summary.moved = moved / 2; // each move is reported at both ends
        summary
    }

    fn block(&mut self, old: &[Word], old_text: &[u8], new: &[Word], new_text: &[u8]) {
        // a code is listed with its number, any other word only with its letter
        let is_code = |word: &Word| matches!(word.letter, 0 | b'G' | b'M');
        let name = |word: &Word, text: &[u8]| {
            let text = String::from_utf8_lossy(&text[word.span.clone()]).trim().to_owned();
            match word.letter {
                0 => text, // a comment is listed as written
                _ if is_code(word) => text.to_ascii_uppercase(),
                letter => char::from(letter).to_string(),
            }
        };
        for word in new.iter().filter(|word| !is_code(word)) {
            match first(old, word.letter) {
                Some(before) if !before.is(word) => {
                    *self.letters.entry(char::from(word.letter)).or_default() += 1;
                }
                Some(_) => {}
                None => *self.more.entry(name(word, new_text)).or_default() += 1,
            }
        }
        for word in old.iter().filter(|word| !is_code(word)) {
            if first(new, word.letter).is_none() {
                *self.less.entry(name(word, old_text)).or_default() += 1;
            }
        }
        let is_in = |word: &Word, text: &[u8], list: &[Word], other: &[u8]| {
            let own = text[word.span.clone()].trim_ascii();
            list.iter().filter(|code| code.letter == word.letter).any(|code| {
                let code = other[code.span.clone()].trim_ascii();
                if word.letter == 0 { own == code } else { own.eq_ignore_ascii_case(code) }
            })
        };
        for code in new.iter().filter(|word| is_code(word) && !is_in(word, new_text, old, old_text)) {
            *self.more.entry(name(code, new_text)).or_default() += 1;
        }
        for code in old.iter().filter(|word| is_code(word) && !is_in(word, old_text, new, new_text)) {
            *self.less.entry(name(code, old_text)).or_default() += 1;
        }
    }
}

/// The first word with a letter.
fn first(list: &[Word], letter: u8) -> Option<&Word> {
    list.iter().find(|word| word.letter == letter)
}
