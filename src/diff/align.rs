//! Blocks of two programs side by side.

use std::collections::HashMap;
use std::ops::Range;
use std::time::Instant;

use similar::{Algorithm, DiffTag, capture_diff_slices_deadline};

use super::ignore::Ignore;
use super::key::key;
use super::program::Program;
use super::words::{likeness, within, words};

/// How programs are compared.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// What does not count.
    pub ignore: Ignore,
    /// By how much numbers of a changed block may differ and be the same.
    pub tolerance: f64,
    /// When to stop looking for the shortest answer: a longer one that is right comes then. `None`: it is looked for to the
    /// end, which for programs of a million lines may be long.
    pub deadline: Option<Deadline>,
}

/// A time, and the clock that knows whether it has come: the library has none.
#[derive(Clone, Copy, Debug)]
pub struct Deadline {
    /// The time at which the search for the shortest answer ends.
    pub at: Instant,
    /// The clock, which is `Instant::now` where there is one.
    pub now: fn() -> Instant,
}

impl Default for Options {
    fn default() -> Self {
        Options { ignore: Ignore::USUAL, tolerance: 0.0, deadline: None }
    }
}

/// One finding. Lines count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edit {
    /// A line of the old program is gone.
    Removed(usize),
    /// A line of the new program was not there.
    Added(usize),
    /// A line became another.
    Changed(usize, usize),
    /// A line stands elsewhere: at this end in the old program, and in the new one.
    Moved(usize, usize),
}

/// Findings that stand together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hunk {
    /// Lines of the old program.
    pub old: Range<usize>,
    /// Lines of the new program.
    pub new: Range<usize>,
    /// Removed and changed lines in the order of the old program, added ones where they stand.
    pub edits: Vec<Edit>,
}

/// What changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Comparison {
    /// Hunks in the order of the programs.
    pub hunks: Vec<Hunk>,
    /// The search for the shortest answer was given up: this one is right and may be longer.
    pub is_coarse: bool,
    /// When to stop looking for short answers, inside blocks too.
    pub until: Option<Instant>,
}

impl Comparison {
    /// Are the programs the same?
    pub fn is_same(&self) -> bool {
        self.hunks.is_empty()
    }

    /// All findings.
    pub fn edits(&self) -> impl Iterator<Item = &Edit> {
        self.hunks.iter().flat_map(|hunk| &hunk.edits)
    }
}

/// Lines that count, with their keys.
struct Lines {
    keys: Vec<u64>,
    numbers: Vec<u32>,
}

impl Lines {
    fn of(program: &Program, ignore: &Ignore) -> Lines {
        let mut lines = Lines { keys: Vec::with_capacity(program.len()), numbers: Vec::with_capacity(program.len()) };
        for number in 0..program.len() {
            if let Some(key) = key(program.line(number), ignore) {
                lines.keys.push(key);
                lines.numbers.push(number as u32);
            }
        }
        lines
    }

    fn number(&self, at: usize) -> usize {
        self.numbers[at] as usize
    }

    /// Lines of the program that a range of those that count covers; an empty one stands before the next line.
    fn covered(&self, range: &Range<usize>, whole: usize) -> Range<usize> {
        if range.is_empty() {
            let at = self.numbers.get(range.start).map_or(whole, |&number| number as usize);
            return at..at;
        }
        self.number(range.start)..self.number(range.end - 1) + 1
    }
}

/// Compares two programs.
pub fn compare(old: &Program, new: &Program, options: &Options) -> Comparison {
    let (before, after) = (Lines::of(old, &options.ignore), Lines::of(new, &options.ignore));
    let until = options.deadline.map(|deadline| deadline.at);
    let ops = capture_diff_slices_deadline(Algorithm::RawMyers, &before.keys, &after.keys, until);
    let is_coarse = options.deadline.is_some_and(|deadline| (deadline.now)() > deadline.at);
    let mut comparison = Comparison { hunks: Vec::new(), is_coarse, until };
    for op in ops {
        let (tag, from, to) = op.as_tag_tuple();
        if tag == DiffTag::Equal {
            continue;
        }
        let edits = pair(old, new, &before, &after, from.clone(), to.clone(), options);
        if !edits.is_empty() {
            let (old, new) = (before.covered(&from, old.len()), after.covered(&to, new.len()));
            comparison.hunks.push(Hunk { old, new, edits });
        }
    }
    find_moves(&mut comparison, old, new, &options.ignore);
    comparison
}

/// Most lines of a hunk that are compared each with each.
const MOST: usize = 64;

/// Which removed line became which added one.
fn pair(
    old: &Program,
    new: &Program,
    before: &Lines,
    after: &Lines,
    from: Range<usize>,
    to: Range<usize>,
    options: &Options,
) -> Vec<Edit> {
    let mut edits = Vec::with_capacity(from.len().max(to.len()));
    let mut next = to.start;
    let even = from.len() == to.len();
    for at in from {
        let line = before.number(at);
        let old_words = words(old.line(line), &options.ignore);
        // line by line where there are as many, else the next one that is alike
        let reach = if even { 1 } else { MOST };
        let found = (next..to.end.min(next + reach)).find_map(|candidate| {
            let number = after.number(candidate);
            let new_words = words(new.line(number), &options.ignore);
            let same = options.tolerance > 0.0 && within(&old_words, &new_words, options.tolerance);
            (same || likeness(&old_words, &new_words) >= 0.5).then_some((candidate, number, same))
        });
        match found {
            Some((candidate, number, same)) => {
                edits.extend((next..candidate).map(|skipped| Edit::Added(after.number(skipped))));
                if !same {
                    edits.push(Edit::Changed(line, number));
                }
                next = candidate + 1;
            }
            None => edits.push(Edit::Removed(line)),
        }
    }
    edits.extend((next..to.end).map(|at| Edit::Added(after.number(at))));
    edits
}

/// A line that is gone here and new there, once each, was moved.
fn find_moves(comparison: &mut Comparison, old: &Program, new: &Program, ignore: &Ignore) {
    let mut gone: HashMap<u64, (usize, usize)> = HashMap::new();
    let mut come: HashMap<u64, (usize, usize)> = HashMap::new();
    for edit in comparison.edits() {
        let (list, line, text) = match *edit {
            Edit::Removed(line) => (&mut gone, line, old.line(line)),
            Edit::Added(line) => (&mut come, line, new.line(line)),
            _ => continue,
        };
        if let Some(key) = key(text, ignore) {
            let seen = list.entry(key).or_insert((0, line));
            seen.0 += 1;
        }
    }
    for edit in comparison.hunks.iter_mut().flat_map(|hunk| &mut hunk.edits) {
        let text = match *edit {
            Edit::Removed(line) => old.line(line),
            Edit::Added(line) => new.line(line),
            _ => continue,
        };
        let Some(key) = key(text, ignore) else { continue };
        if let (Some((1, from)), Some((1, to))) = (gone.get(&key), come.get(&key)) {
            *edit = Edit::Moved(*from, *to);
        }
    }
}
