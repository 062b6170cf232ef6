//! The parts of two programs between lines that are the same, byte for byte: most programs that are compared differ in few
//! blocks, and only those parts need a key for each line and a search.

use std::ops::Range;

use super::program::Program;

/// Lines of the old and the new program that must be compared; between two such parts the lines are the same.
pub(super) type Gap = [Range<usize>; 2];

/// So many lines after a difference, on either side, it is looked for lines that are the same again.
const WINDOW: usize = 64;

/// So many lines in a row must be the same again: fewer may be so by chance in programs whose blocks repeat, and the answer would be
/// longer than it must be.
const RUN: usize = 32;

/// Programs of fewer lines are searched as a whole: where blocks repeat, lines that are the same again may not be those of the
/// shortest answer.
const SMALL: usize = 20_000;

/// Finds the parts. Where the programs are small, or do not meet again within a few lines, the last part is all that is left, without the
/// lines that are the same at the end.
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

/// Where the lines of two parts are the same again, after as few lines as can be.
fn meet([a, b]: Gap, same: impl Fn(usize, usize) -> bool) -> Option<(usize, usize)> {
    let is_run = |x: usize, y: usize| x + RUN <= a.end && y + RUN <= b.end && (0..RUN).all(|at| same(x + at, y + at));
    (1..=WINDOW).find_map(|far| {
        // changed lines first, then added or removed ones, then both
        let ways = (0..far).flat_map(|near| [(near, far), (far, near)]);
        let mut found = std::iter::once((far, far)).chain(ways).map(|(old, new)| (a.start + old, b.start + new));
        found.find(|&(x, y)| is_run(x, y))
    })
}
