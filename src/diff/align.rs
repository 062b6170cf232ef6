//! Compares two programs: finds the removed, added, changed and moved lines.

use std::ops::Range;

use similar::{Algorithm, DiffTag, capture_diff_slices};

use super::gaps::gaps;
use super::ignore::Ignore;
use super::key::key;
use super::lines::{Lines, both};
use super::program::Program;
use super::words::{letters, likeness, within, words};

/// Settings of a comparison.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The kinds of differences that are ignored.
    pub ignore: Ignore,
    /// If the numbers of a changed block differ by at most this value, they are equal.
    pub tolerance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options { ignore: Ignore::USUAL, tolerance: 0.0 }
    }
}

/// One difference. Lines are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edit {
    /// A line of the old program is missing in the new one.
    Removed(usize),
    /// A line of the new program is missing in the old one.
    Added(usize),
    /// A line of the old program was changed into a line of the new program.
    Changed(usize, usize),
    /// A line moved: its number in the old program, and its number in the new one.
    Moved(usize, usize),
}

/// Adjacent differences.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hunk {
    /// Lines of the old program.
    pub old: Range<usize>,
    /// Lines of the new program.
    pub new: Range<usize>,
    /// Removed and changed lines in the order of the old program. Each added line is at its position between the
    /// removed and changed lines.
    pub edits: Vec<Edit>,
}

/// The result of a comparison.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Comparison {
    /// Hunks in the order of the programs.
    pub hunks: Vec<Hunk>,
}

impl Comparison {
    /// Whether the programs are equal.
    pub fn is_same(&self) -> bool {
        self.hunks.is_empty()
    }

    /// All differences.
    pub fn edits(&self) -> impl Iterator<Item = &Edit> {
        self.hunks.iter().flat_map(|hunk| &hunk.edits)
    }
}

/// Compares two programs. The search for the shortest list of differences is limited in steps, not in time; so the result
/// is the same on every machine. If two large programs have little in common, the list may be longer than necessary.
pub fn compare(old: &Program, new: &Program, options: &Options) -> Comparison {
    let mut comparison = Comparison::default();
    for [from, to] in gaps(old, new) {
        let [before, after] = both(old, from, new, to, &options.ignore);
        for op in capture_diff_slices(Algorithm::Myers, before.keys(), after.keys()) {
            let (tag, from, to) = op.as_tag_tuple();
            if tag == DiffTag::Equal {
                continue;
            }
            let (from, to) = (before.compared(from), after.compared(to));
            let edits = pair(old, new, &before, &after, from.clone(), to.clone(), options);
            if !edits.is_empty() {
                comparison.hunks.push(Hunk { old: before.covered(&from), new: after.covered(&to), edits });
            }
        }
    }
    find_moves(&mut comparison, old, new, &options.ignore);
    comparison
}

/// Maximum number of added lines that are compared with a removed line, in a hunk whose numbers of removed and added
/// lines differ.
const MOST: usize = 64;

/// Pairs each removed line with the added line that replaced it.
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
    let ignore = &options.ignore;
    let [mut old_letters, mut new_letters] = [Vec::new(), Vec::new()];
    for at in from {
        let line = before.number(at);
        letters(old.line(line), ignore, &mut old_letters);
        let old_words = (options.tolerance > 0.0).then(|| words(old.line(line), ignore));
        // with as many added as removed lines, the line at the same position; otherwise the next similar line
        let reach = if even { 1 } else { MOST };
        let found = (next..to.end.min(next + reach)).find_map(|candidate| {
            let number = after.number(candidate);
            let is = new.line(number);
            let same = old_words.as_ref().is_some_and(|was| within(was, &words(is, ignore), options.tolerance));
            letters(is, ignore, &mut new_letters);
            (same || likeness(&old_letters, &new_letters) >= 0.5).then_some((candidate, number, same))
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

/// Marks a line as moved if it is removed once and added once elsewhere.
fn find_moves(comparison: &mut Comparison, old: &Program, new: &Program, ignore: &Ignore) {
    let (mut gone, mut come) = (Vec::new(), Vec::new());
    for edit in comparison.edits() {
        let (list, line, program) = match *edit {
            Edit::Removed(line) => (&mut gone, line, old),
            Edit::Added(line) => (&mut come, line, new),
            _ => continue,
        };
        if let Some(key) = key(program.line(line), ignore, program.targets()) {
            list.push((key, line as u32));
        }
    }
    let mut come = once(&mut come).peekable();
    let mut moves = Vec::new();
    for (key, from) in once(&mut gone) {
        while come.next_if(|(other, _)| *other < key).is_some() {}
        moves.extend(come.next_if(|(other, _)| *other == key).map(|(_, to)| (from as usize, to as usize)));
    }
    // removed lines are in the order of the old program, added lines in the order of the new one
    let mut by_old = moves.clone();
    by_old.sort_unstable();
    moves.sort_unstable_by_key(|&(_, to)| to);
    let (mut by_old, mut by_new) = (by_old.into_iter().peekable(), moves.into_iter().peekable());
    for edit in comparison.hunks.iter_mut().flat_map(|hunk| &mut hunk.edits) {
        let moved = match *edit {
            Edit::Removed(line) => by_old.next_if(|&(from, _)| from == line),
            Edit::Added(line) => by_new.next_if(|&(_, to)| to == line),
            _ => None,
        };
        if let Some((from, to)) = moved {
            *edit = Edit::Moved(from, to);
        }
    }
}

/// The entries whose key occurs once, in the order of their keys.
fn once(list: &mut [(u64, u32)]) -> impl Iterator<Item = (u64, u32)> {
    list.sort_unstable();
    list.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1).map(|same| same[0])
}
