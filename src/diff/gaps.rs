//! Finds the parts in which two programs differ, by comparing lines byte for byte. Two programs usually
//! differ in only a few blocks. Only the parts with differences need a key for each line and a search.

use std::ops::Range;

use super::program::Program;

/// A range of lines of the old program and one of the new program that must be compared. The lines outside of these
/// ranges are equal.
pub(super) type Gap = [Range<usize>; 2];

/// Equal lines are searched within this number of lines after a difference, in both programs.
const WINDOW: usize = 64;

/// Number of consecutive lines that must be equal. If this number were smaller, repeated blocks could be equal by
/// chance, and the list of differences would be longer than necessary.
const RUN: usize = 32;

/// Programs with fewer lines than this number are searched as a whole: in programs with repeated blocks, the first
/// equal lines may not belong to the shortest list of differences.
const SMALL: usize = 20_000;

/// Finds the parts that differ. In small programs, the last part is the whole rest without the equal lines at the end.
/// The last part is also the whole rest if no equal lines follow within `WINDOW`.
pub(super) fn gaps(old: &Program, new: &Program) -> Vec<Gap> {
    let same = |a: usize, b: usize| old.line(a) == new.line(b);
    let most = old.len().min(new.len());
    let tail = (0..most).take_while(|back| same(old.len() - 1 - back, new.len() - 1 - back)).count();
    let (a_end, b_end) = (old.len() - tail, new.len() - tail);
    let is_small = old.len().max(new.len()) < SMALL;
    let (mut a, mut b, mut gaps) = (0, 0, Vec::new());
    loop {
        while a < a_end && b < b_end && same(a, b) {
            (a, b) = (a + 1, b + 1);
        }
        if (a, b) == (a_end, b_end) {
            return gaps;
        }
        let next = if is_small { None } else { meet([a..a_end, b..b_end], same) };
        let Some((x, y)) = next else {
            gaps.push([a..a_end, b..b_end]);
            return gaps;
        };
        gaps.push([a..x, b..y]);
        (a, b) = (x, y);
    }
}

/// The nearest positions in the old and the new part at which equal lines begin again.
fn meet([a, b]: Gap, same: impl Fn(usize, usize) -> bool) -> Option<(usize, usize)> {
    let is_run = |x: usize, y: usize| x + RUN <= a.end && y + RUN <= b.end && (0..RUN).all(|at| same(x + at, y + at));
    (1..=WINDOW).find_map(|far| {
        // search order: lines were changed, lines were added or removed, both
        let ways = (0..far).flat_map(|near| [(near, far), (far, near)]);
        let mut found = std::iter::once((far, far)).chain(ways).map(|(old, new)| (a.start + old, b.start + new));
        found.find(|&(x, y)| is_run(x, y))
    })
}
