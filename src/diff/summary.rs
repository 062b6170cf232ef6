//! Counts the changes by kind.

use std::collections::{BTreeMap, HashSet};

use super::align::{Comparison, Edit};
use super::ignore::Ignore;
use super::program::Program;
use super::words::{Word, words};
use crate::source::text_of;

/// The numbers of changes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Numbers of changed, removed, added and moved blocks.
    pub changed: usize,
    #[allow(missing_docs)]
    pub removed: usize,
    #[allow(missing_docs)]
    pub added: usize,
    #[allow(missing_docs)]
    pub moved: usize,
    /// For each letter, the number of changed blocks in which the number after the letter changed.
    pub letters: BTreeMap<char, usize>,
    /// Codes and words that were added to changed blocks (`more`) or removed from them (`less`), each with its count.
    pub more: BTreeMap<String, usize>,
    #[allow(missing_docs)]
    pub less: BTreeMap<String, usize>,
}

impl Summary {
    /// Counts the changes of a comparison.
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
        summary.moved = moved / 2; // the list contains each moved line twice
        summary
    }

    fn block(&mut self, old: &[Word], old_text: &[u8], new: &[Word], new_text: &[u8]) {
        // a code is listed with its number, any other word only with its letter
        let is_code = |word: &Word| matches!(word.letter, 0 | b'G' | b'M');
        let name = |word: &Word, text: &[u8]| {
            let text = text_of(&text[word.span.clone()]).trim().to_owned();
            match word.letter {
                0 => text, // a comment is listed as written
                _ if is_code(word) => text.to_ascii_uppercase(),
                letter => char::from(letter).to_string(),
            }
        };
        let (olds, news) = (firsts(old), firsts(new));
        for word in new.iter().filter(|word| !is_code(word)) {
            match olds[usize::from(word.letter)].checked_sub(1).map(|at| &old[at]) {
                Some(before) if !before.is(word) => {
                    *self.letters.entry(char::from(word.letter)).or_default() += 1;
                }
                Some(_) => {}
                None => *self.more.entry(name(word, new_text)).or_default() += 1,
            }
        }
        for word in old.iter().filter(|word| !is_code(word)) {
            if news[usize::from(word.letter)] == 0 {
                *self.less.entry(name(word, old_text)).or_default() += 1;
            }
        }
        let codes = |list: &[Word], text: &[u8]| -> Vec<String> {
            list.iter().filter(|word| is_code(word)).map(|word| name(word, text)).collect()
        };
        let [was, is] = [old, new].map(|list| list.iter().filter(|word| is_code(word)));
        if was.clone().count() == is.clone().count()
            && was.zip(is).all(|(was, is)| old_text[was.span.clone()] == new_text[is.span.clone()])
        {
            return; // most blocks have the same codes and words
        }
        let (before, after) = (codes(old, old_text), codes(new, new_text));
        let [in_before, in_after] = [&before, &after].map(|list| list.iter().collect::<HashSet<_>>());
        for code in after.iter().filter(|code| !in_before.contains(code)) {
            *self.more.entry(code.clone()).or_default() += 1;
        }
        for code in before.iter().filter(|code| !in_after.contains(code)) {
            *self.less.entry(code.clone()).or_default() += 1;
        }
    }
}

/// For each letter, the position of the first word with this letter, counted from 1; 0: no word has the letter.
fn firsts(list: &[Word]) -> [usize; 256] {
    let mut firsts = [0; 256];
    list.iter().enumerate().rev().for_each(|(at, word)| firsts[usize::from(word.letter)] = at + 1);
    firsts
}
