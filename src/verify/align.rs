//! Pairs each cut of the job with a cut of the program. Two kinds of cuts have no partner: cuts shorter than the
//! program's digits, and cuts that the program repeats after the tool was taken out.

use super::cut::{ACROSS, ALL, Cut, DEPTH, What, apart, lead_alike, lies_between, same, same_ends};
use super::intent::Done;
use super::modal::has_feed;
use super::passage::Passage;
use super::sides::Sides;
use super::{arcs, begin};

/// Whether the program leaves out this cut of the job because the cut is shorter than the program's digits. If `true`,
/// the cut needs no further comparison. Cuts of holes are never left out.
pub(super) fn leaves_out(s: &mut Sides<'_>, cut: &Cut) -> Done<bool> {
    if !cut.is_short(s.limits.tolerance) || !vanishes(s, cut)? {
        return Ok(false);
    }
    s.report.allowed.short += 1;
    s.job.goes_on(cut.end());
    Ok(true)
}

/// The program's next cut that can correspond to this cut of the job. Earlier cuts of the program that the job does not
/// need are skipped. `None`: the program has no more cuts.
pub(super) fn partner(s: &mut Sides<'_>, cut: &Cut) -> Done<Option<Cut>> {
    while let Some(found) = s.next()? {
        if enters_again(s, cut, &found) {
            s.report.allowed.entries += 1;
            s.program.take();
        } else if is_put_in(s, cut, &found) {
            s.report.allowed.short += 1;
            s.program.pass_over();
        } else {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// The program's next cut after the job's last cut. Cuts that are too short to matter are skipped.
pub(super) fn after_the_last(s: &mut Sides<'_>) -> Done<Option<Cut>> {
    while let Some(found) = s.next()? {
        if is_nothing(s, &found) {
            s.report.allowed.short += 1;
        } else if !begin::is_the_jobs_rapid(s, &found) {
            return Ok(Some(found));
        }
        s.program.pass_over();
    }
    Ok(None)
}

/// Whether a cut of the program is too short to matter, and is not the job's cut or its first part.
fn is_put_in(s: &Sides<'_>, cut: &Cut, found: &Cut) -> bool {
    !found.by_cycle
        && is_nothing(s, found)
        && !cut.is_short(s.limits.tolerance)
        && !is_itself(s, cut, found)
        && !is_part(s, cut, found)
}

/// Whether a very short cut of the job has no length in the program, because the program's positions are rounded.
/// `false` if the program makes the cut.
fn vanishes(s: &mut Sides<'_>, cut: &Cut) -> Done<bool> {
    let Some(found) = s.next()? else { return Ok(true) };
    let tolerance = s.limits.tolerance;
    let [to_end, to_begin] = [found.end(), found.from].map(|place| apart(&place, &cut.end()));
    // if the program's digits show the cut, rapids before it do not matter
    let shows = to_end + tolerance / 2.0 < to_begin;
    let joins = found.unknown == 0
        && (shows || joins_alike(s))
        && has_feed(cut, &found, false)
        && same_ends(cut, &found, tolerance);
    let pauses = |passage: &Passage| (passage.stops.len(), passage.waits.len());
    let joins = joins && pauses(&s.program.passage) == pauses(&s.job);
    // a cut in another direction belongs to another cut of the job
    let joins = joins && lead_alike(cut, &found);
    let nearer = to_end <= to_begin + 1e-9;
    let circle = matches!(found.what, What::Arc(_)) && !found.is_short(tolerance);
    Ok(!joins || !nearer || circle)
}

/// Whether the next cuts of job and program both follow directly on a cut, or both follow on rapids.
fn joins_alike(s: &Sides<'_>) -> bool {
    let (a, b, tolerance) = (&s.program.passage, &s.job, s.limits.tolerance);
    a.rapids.is_empty() == b.rapids.is_empty() || a.stays(tolerance) && b.stays(tolerance)
}

/// Whether a cut of the program is too short to matter. The greatest length of such a cut is twice the tolerance,
/// because both ends of the cut are rounded.
fn is_nothing(s: &Sides<'_>, found: &Cut) -> bool {
    found.unknown == 0 && found.is_short(2.0 * s.limits.tolerance)
}

/// Whether a short cut of the program is the job's cut. The job's cut may be up to four tolerances long.
fn is_itself(s: &Sides<'_>, cut: &Cut, found: &Cut) -> bool {
    let tolerance = s.limits.tolerance;
    // this also covers a full circle, which ends where it begins
    same_ends(cut, found, tolerance) && cut.is_short(4.0 * tolerance) && lead_alike(cut, found)
}

/// Whether a short cut of the program is the first part of the job's cut. `false` if the program's cut ends at the
/// beginning of the job's cut.
fn is_part(s: &Sides<'_>, cut: &Cut, found: &Cut) -> bool {
    let tolerance = s.limits.tolerance;
    let goes_along = match (cut.what, found.what) {
        (What::Line { .. }, _) => lies_between(&cut.from, &found.end(), &cut.end(), tolerance),
        (What::Arc(turn), What::Arc(made)) => (made.plane, made.direction) == (turn.plane, turn.direction),
        (What::Arc(turn), What::Line { to }) => arcs::is_chord(cut, &turn, &to, tolerance),
    };
    goes_along && same(&cut.from, &found.from, ALL, tolerance) && !same(&cut.from, &found.end(), ALL, tolerance)
}

/// Whether the program only returns straight down to the position where the job's cut continues. A program returns in
/// this way after the tool was taken out, for example to unwind a rotary axis.
fn enters_again(s: &mut Sides<'_>, cut: &Cut, found: &Cut) -> bool {
    let What::Line { to } = found.what else { return false };
    let tolerance = s.limits.tolerance;
    let way = &s.program.passage;
    if way.rapids.is_empty() || way.changed() || s.job.changed() {
        return false;
    }
    let here = s.job.start.is_some_and(|start| same(&start.to, &cut.from, ALL, tolerance))
        || way.rapids.iter().any(|rapid| rapid.unknown & 1 << DEPTH != 0);
    let height_known = found.unknown & 1 << DEPTH == 0;
    if !here || found.unknown & ACROSS != 0 || !same(&cut.from, &to, ALL, tolerance) {
        return false;
    }
    let [_, program] = &mut s.ways;
    program.set(way.start, &way.rapids, tolerance);
    let above = !height_known || found.from[DEPTH] > to[DEPTH] + tolerance;
    same(&found.from, &to, ACROSS, tolerance) && above && program.stays_above(to[DEPTH])
}
