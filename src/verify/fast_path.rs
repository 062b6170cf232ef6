//! Fast comparisons for the two most frequent cuts that are equal in job and program: a straight cut directly after a
//! straight cut, and the cut of a hole after equal rapids. Most cuts of long jobs are of these kinds, so they are
//! compared without copies. The general comparison handles all other cuts; it would have the same result for the cuts
//! of this module.

use super::cut::{ALL, Cut, Place, Rapid, What, same, same_ends, turn_as_far};
use super::intent::{Done, Expected, Straight};
use super::modal::{has_feed, is_feed};
use super::rapids::{moves_as_before, same_rapids};
use super::sides::Sides;
use crate::lang::Machine;

/// Shortest cut for the fast comparison, as a multiple of the tolerance. A longer cut is always longer than the
/// rounding of its positions.
const LONG: f64 = 4.0;

/// Whether a straight cut is too long to vanish in the rounding of its positions.
#[inline]
fn is_long(from: &Place, to: &Place, tolerance: f64) -> bool {
    (0..3).any(|axis| (to[axis] - from[axis]).abs() > LONG * tolerance)
}

/// Whether the program's next cut equals the job's cut, and both cuts directly follow another cut. If `true`, the cut
/// is counted as compared.
#[inline]
pub(super) fn goes_on(s: &mut Sides<'_>, cut: &Straight<'_>) -> bool {
    let Straight { from: start, to, .. } = *cut;
    let tolerance = s.limits.tolerance;
    if !is_long(start, to, tolerance) || !s.job.is_plain() || s.job.new_tool {
        return false;
    }
    let Some((from, mode, state)) = s.program.before_plain() else { return false };
    let agree = s.agreed.as_ref().is_some_and(|[wanted, is]| wanted == cut.state && is == state);
    if !agree || mode != cut.mode || !same(start, from, ALL, tolerance) {
        return false;
    }
    let from = *from;
    let Some(found) = s.program.next_plain() else { return false };
    let is_usual = cut.feed.is_none_or(|feed| is_feed(feed, found.feed, false))
        && same(to, &found.to, ALL, tolerance)
        && turn_as_far([start, to], [&from, &found.to]);
    if is_usual {
        (s.slipped, s.slips) = (None, 0);
        s.report.counts.cuts += 1;
        s.program.take_plain(&found);
        s.threaded = None;
        (s.hole.highest, s.hole.inside) = (None, None);
        s.leave_at(*to);
    }
    is_usual
}

/// Whether the program's next cut is the job's cut of a hole, after the same rapids and in the same state. If `true`,
/// the cut needs no further comparison.
///
/// # Errors
/// The program can't be run to its next cut.
pub(super) fn drills(s: &mut Sides<'_>, cut: &Cut, hole: &Expected) -> Done<bool> {
    s.run_to_cut()?;
    let tolerance = s.limits.tolerance;
    let Some(found) = s.program.cut() else { return Ok(false) };
    let (What::Line { to }, What::Line { .. }) = (&cut.what, &found.what) else { return Ok(false) };
    let both_plain = [&s.job, &s.program.passage].into_iter().all(|passage| passage.only_moves() && !passage.new_tool);
    let agree = s.agreed.as_ref().is_some_and(|[wanted, is]| *wanted == cut.state && *is == found.state);
    let is_usual = is_long(&cut.from, to, tolerance)
        && s.machine == Machine::Mill
        && both_plain
        && agree
        && cut.unknown | found.unknown | found.home | found.open == 0
        && cut.mode == found.mode
        && cut.lead.is_none()
        && found.lead.is_none()
        && same_ends(cut, found, tolerance)
        && has_feed(cut, found, hole.is_tap)
        && moves_as_before(s)
        && same_rapids(s);
    if is_usual {
        let starts = [s.job.start, s.program.passage.start].map(|start| start.map(|start| start.to));
        let goes_across = |start: Option<Place>, cut: &Cut| start.is_some_and(|start| start[..2] != cut.from[..2]);
        s.hole.is_usual = goes_across(starts[0], cut) && goes_across(starts[1], found);
        s.before = found.state.clone();
        (s.slipped, s.slips) = (None, 0);
        s.program.take();
        s.program.expects_hole();
        s.leave(cut, Some(hole));
    }
    Ok(is_usual)
}

/// Whether the program makes the job's next hole, which differs from the last two holes only in its position, and makes
/// it like its own last two holes. If `true`, the hole needs no further comparison: with the same shift on both sides,
/// the comparison of the last hole holds for this one.
pub(super) fn drills_again(s: &mut Sides<'_>, at: [f64; 2]) -> bool {
    let is_usual = s.hole.is_usual && s.job.only_lifts() && !s.job.new_tool;
    let Some(Rapid { to: mut end, .. }) = s.job.start.filter(|_| is_usual) else { return false };
    // without a move to the hole, the job would have other rapids
    if end[..2] == at {
        return false;
    }
    (end[0], end[1]) = (at[0], at[1]);
    if !s.program.next_hole(&end, s.limits.tolerance) {
        return false;
    }
    s.job.shift(at);
    if let Some(last) = &mut s.hole.last {
        (last.at[0], last.at[1]) = (at[0], at[1]);
    }
    s.report.counts.holes += 1;
    true
}
