//! The compared lines of a part of a program, and which of these lines reach the search.

use std::collections::HashSet;
use std::ops::Range;

use foldhash::fast::FixedState;

use super::ignore::Ignore;
use super::key::key;
use super::program::Program;

/// The compared lines of a part of a program.
pub(super) struct Lines {
    /// The line number of each compared line. Lines are counted from 0.
    numbers: Vec<u32>,
    /// Number of the first line after the part.
    end: usize,
    /// The keys of the searched lines.
    keys: Vec<u64>,
    /// For each searched line, its index in `numbers`.
    searched: Vec<u32>,
}

impl Lines {
    /// The lines of a part that are not ignored, with the keys of all lines.
    fn of(program: &Program, part: Range<usize>, ignore: &Ignore) -> Lines {
        let end = part.end;
        let (mut keys, mut numbers) = (Vec::with_capacity(part.len()), Vec::with_capacity(part.len()));
        for number in part {
            if let Some(key) = key(program.line(number), ignore, program.targets()) {
                keys.push(key);
                numbers.push(number as u32);
            }
        }
        Lines { numbers, end, keys, searched: Vec::new() }
    }

    /// The keys of the searched lines.
    pub(super) fn keys(&self) -> &[u64] {
        &self.keys
    }

    /// The range of compared lines for a range of searched lines. The result includes the lines that were left out of
    /// the search after a line of the range.
    pub(super) fn compared(&self, searched: Range<usize>) -> Range<usize> {
        let at = |at: usize| self.searched.get(at).map_or(self.numbers.len(), |&index| index as usize);
        at(searched.start)..at(searched.end)
    }

    /// The line number of a compared line.
    pub(super) fn number(&self, at: usize) -> usize {
        self.numbers[at] as usize
    }

    /// The lines of the program from the first to the last line of a range of compared lines. For an empty range, the
    /// result is an empty range before the next compared line, or at the end of the part.
    pub(super) fn covered(&self, range: &Range<usize>) -> Range<usize> {
        if range.is_empty() {
            let at = self.numbers.get(range.start).map_or(self.end, |&number| number as usize);
            return at..at;
        }
        self.number(range.start)..self.number(range.end - 1) + 1
    }

    /// Leaves lines out of the search that the other part lacks. The first [`NEAR`] lines of a run of such
    /// lines are searched.
    fn keep(&mut self, other: &Keys) {
        let mut run = 0;
        for at in 0..self.keys.len() {
            run = if other.contains(&self.keys[at]) { 0 } else { run + 1 };
            if run <= NEAR {
                self.keys[self.searched.len()] = self.keys[at];
                self.searched.push(at as u32);
            }
        }
        self.keys.truncate(self.searched.len());
        self.keys.shrink_to_fit();
    }
}

/// A set of keys.
type Keys = HashSet<u64, FixedState>;

/// The search looks at this number of neighbours of a frequent line to decide whether the line is compared. Lines
/// farther away have no influence.
const NEAR: usize = 100;

/// The compared lines of a part of the old program and of a part of the new program. Lines that the other part lacks
/// are left out of the search; so the memory and the time of the search depend on the lines that both parts have.
pub(super) fn both(old: &Program, from: Range<usize>, new: &Program, to: Range<usize>, ignore: &Ignore) -> [Lines; 2] {
    let (mut before, mut after) = (Lines::of(old, from, ignore), Lines::of(new, to, ignore));
    let keys_of = |lines: &Lines| lines.keys.iter().copied().collect::<Keys>();
    let old_keys = keys_of(&before);
    before.keep(&keys_of(&after));
    after.keep(&old_keys);
    [before, after]
}
