//! The usual cut: a straight cut that follows another one, equal in job and program. It is compared without copies,
//! because most cuts of long jobs are of this kind. All other cuts take the general path, which has the same result for
//! usual cuts.

use super::cut::{ALL, Cut, What, same, turn_as_far};
use super::intent::Done;
use super::modal::has_feed;
use super::passage::Passage;
use super::sides::Sides;

/// Length of the shortest usual cut in tolerances. Such a cut can't disappear in the digits of either side.
const LONG: f64 = 4.0;

/// Whether the program's next cut is the job's cut and follows directly on the last one, without anything between. If so,
/// the cut is done.
///
/// # Errors
/// The program can't be run to its next cut.
pub(super) fn goes_on(s: &mut Sides<'_>, cut: &Cut) -> Done<bool> {
    let What::Line { to } = &cut.what else { return Ok(false) };
    let goes_on = |passage: &Passage| passage.is_plain() && !passage.new_tool;
    if !goes_on(&s.job) || cut.unknown != 0 || cut.lead.is_some() {
        return Ok(false);
    }
    s.run_to_cut()?;
    let tolerance = s.limits.tolerance;
    let Some(found) = s.program.cut() else { return Ok(false) };
    let What::Line { to: made } = &found.what else { return Ok(false) };
    let is_long = (0..3).any(|axis| (to[axis] - cut.from[axis]).abs() > LONG * tolerance);
    let is_usual = is_long
        && goes_on(&s.program.passage)
        && (found.unknown, found.lead, found.by_cycle) == (0, None, false)
        && found.mode == cut.mode
        && has_feed(cut, found)
        && same(&cut.from, &found.from, ALL, tolerance)
        && same(to, made, ALL, tolerance)
        && turn_as_far([&cut.from, to], [&found.from, made])
        && s.agreed.as_ref().is_some_and(|[wanted, is]| *wanted == cut.state && *is == found.state);
    if is_usual {
        (s.slipped, s.slips) = (None, 0);
        s.report.counts.cuts += 1;
        s.program.take();
        s.leave(cut, None);
    }
    Ok(is_usual)
}
