//! A fast path for the most frequent case: a straight cut after a straight cut, equal in job and program. Most cuts of long
//! jobs are of this kind, so they are compared without copies. All other cuts take the general comparison, which has the
//! same result for the cuts handled here.

use super::cut::{ALL, Cut, What, same, turn_as_far};
use super::modal::is_feed;
use super::sides::Sides;

/// Shortest cut for the fast path, in tolerances. The rounding of either side can't remove a longer cut.
const LONG: f64 = 4.0;

/// Whether the program's next cut equals the job's cut and both follow directly on the previous cut. If so, the cut is
/// counted as compared.
pub(super) fn goes_on(s: &mut Sides<'_>, cut: &Cut) -> bool {
    let What::Line { to } = &cut.what else { return false };
    let tolerance = s.limits.tolerance;
    let is_long = (0..3).any(|axis| (to[axis] - cut.from[axis]).abs() > LONG * tolerance);
    if !is_long || !s.job.is_plain() || s.job.new_tool || cut.unknown != 0 || cut.lead.is_some() {
        return false;
    }
    let Some((from, mode, state)) = s.program.before_plain() else { return false };
    let agree = s.agreed.as_ref().is_some_and(|[wanted, is]| *wanted == cut.state && is == state);
    if !agree || mode != cut.mode || !same(&cut.from, from, ALL, tolerance) {
        return false;
    }
    let from = *from;
    let Some(found) = s.program.next_plain() else { return false };
    let is_usual = cut.feed.is_none_or(|feed| is_feed(feed, found.feed, false))
        && same(to, &found.to, ALL, tolerance)
        && turn_as_far([&cut.from, to], [&from, &found.to]);
    if is_usual {
        (s.slipped, s.slips) = (None, 0);
        s.report.counts.cuts += 1;
        s.program.take_plain(&found);
        s.leave(cut, None);
    }
    is_usual
}
