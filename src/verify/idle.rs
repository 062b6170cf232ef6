//! Compares paths without a cut: paths of a tool or a work offset that makes no cut, and paths after the program's last
//! cut.

use super::cut::{ALL, Rapid, same};
use super::passage::{Frame, Passage};
use super::rapid_path::RapidPath;
use super::ways::{Compared, compare as compare_way};

/// Counts the job's paths without a cut that are missing in the program. `at_end`: the comparison is made after the
/// last cut, so no cut follows the last path. `tools`: the machine loads tools.
pub(super) fn otherwise(job: &Passage, program: &Passage, at_end: bool, tools: bool, tolerance: f64) -> u64 {
    // the first path leads away from a cut, if there was one
    let leaves = usize::from(job.start.is_some());
    let mut made = ways(program, leaves, at_end);
    let wanted = ways(job, leaves, at_end).filter(|(_, rapids)| !rapids.is_empty());
    let mut count = 0;
    for (frame, rapids) in wanted {
        let is_frame =
            |other: &Frame| frame.work.is_none_or(|_| frame.work == other.work) && (!tools || frame.tool == other.tool);
        let there = made.by_ref().find(|(other, rapids)| is_frame(other) && !rapids.is_empty());
        count += u64::from(!there.is_some_and(|(_, other)| is_made(rapids, other, tolerance)));
    }
    count
}

/// The paths without a cut, with their frames. Final rapids to machine positions are left out.
fn ways(passage: &Passage, leaves: usize, at_end: bool) -> impl Iterator<Item = (Frame, &[Rapid])> {
    let count = passage.legs().count().saturating_sub(leaves + usize::from(!at_end));
    passage.legs().skip(leaves).take(count).map(|(leg, rapids)| {
        let known = rapids.iter().rposition(|rapid| rapid.unknown == 0).map_or(0, |last| last + 1);
        (leg.frame, &rapids[..known])
    })
}

/// Whether the program goes to the job's positions, is nowhere lower than the job and ends at the job's last position.
fn is_made(job: &[Rapid], program: &[Rapid], tolerance: f64) -> bool {
    let (mut own, mut other) = (RapidPath::default(), RapidPath::default());
    own.set(None, job, tolerance);
    other.set(None, program, tolerance);
    let ends = job.last().zip(program.last()).is_some_and(|(a, b)| same(&a.to, &b.to, ALL & !a.unknown, tolerance));
    ends && matches!(compare_way(&mut own, &mut other, false, tolerance), Compared::Same | Compared::AsGood { .. })
}
