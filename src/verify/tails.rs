//! Compares the program's path after the last cut with the job's path.

use super::cut::{ACROSS, ALL, Place, Rapid, same};
use super::rapid_path::{RapidPath, across, crossing, highest, home_crossing, known_heights};
use super::ways::{ROUNDED_ACROSS, goes_upright_elsewhere, is_over, low_at_machine};

/// Checks the program's path after the last cut. No move across may be lower than the job's moves across. Below the
/// job's greatest height, a move across must be above one of the job's rapids. The tool may go down only where the job
/// goes down.
pub(super) fn leaves_low(job: &RapidPath, program: &RapidPath, tolerance: f64) -> Option<(Place, f64)> {
    let (highest, crossing) = (highest(&job.corners), crossing(&job.corners, tolerance));
    // if the job does not move across, rapids to machine positions must be higher than its last height
    let stays = across(&job.corners, tolerance).next().is_none() && !job.corners.is_empty();
    let home = home_crossing(&job.corners, tolerance);
    let low = across(&program.corners, ROUNDED_ACROSS * tolerance).find(|(a, b)| {
        let at = a.height().min(b.height());
        let is_elsewhere = at < highest - tolerance && !is_over(a, b, &job.corners, tolerance);
        let goes_home_low = home.map_or(stays && at < crossing + tolerance, |home| at < home - tolerance);
        at < crossing - tolerance || is_elsewhere || b.unknown & ACROSS != 0 && goes_home_low
    });
    if let Some((_, b)) = low {
        return Some((b.to, crossing));
    }
    if let Some((to, height)) = low_at_machine(&job.corners, &program.corners, tolerance) {
        return Some((to.to, height));
    }
    if let Some(to) = goes_upright_elsewhere(&job.corners, &program.corners, highest, tolerance) {
        return Some((to.to, highest));
    }
    // The tool may go down only where the job goes down, and not lower. Elsewhere it must not be below the job's moves
    // across. If the job only goes up, the tool must not go down.
    let after_start = || job.corners.iter().skip(1);
    let lowest = known_heights(after_start()).reduce(f64::min).unwrap_or(highest);
    let floor = |at: &Rapid| {
        let there = |own: &&Rapid| {
            at.unknown & 0b11 != 0 || own.unknown & 0b11 != 0 || same(&own.to, &at.to, ACROSS, tolerance)
        };
        let own = known_heights(after_start().filter(there)).reduce(f64::min);
        own.unwrap_or(lowest.max(crossing))
    };
    // a cycle of the control may leave the hole higher than the job; the program may then go straight down to the job's
    // position
    let comes_back = |at: usize| {
        let is_left = |rapid: &Rapid, axes| {
            let left = job.corners.first().filter(|left| left.unknown | rapid.unknown == 0);
            left.is_some_and(|left| same(&left.to, &rapid.to, axes, tolerance))
        };
        program.corners[1..=at].iter().all(|rapid| is_left(rapid, ACROSS)) && is_left(&program.corners[at + 1], ALL)
    };
    let mut pairs = program.corners.windows(2).enumerate();
    let dives = pairs.find(|(at, pair)| {
        pair[1].height() < pair[0].height() && pair[1].height() < floor(&pair[1]) - tolerance && !comes_back(*at)
    });
    dives.map(|(_, pair)| (pair[1].to, floor(&pair[1])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::cut::place;

    fn path(points: &[[f64; 3]]) -> RapidPath {
        let rapid =
            |&[x, y, z]: &[f64; 3]| Rapid { to: place(&[x, y, z, 0.0, 0.0, 0.0]), unknown: 0, kept: 0, spin: None };
        let mut path = RapidPath::default();
        path.set(None, &points.iter().map(rapid).collect::<Vec<_>>(), 1e-4);
        path
    }

    /// A T-slot cutter leaves its slot at the end of the slot: not before, and not beyond.
    #[test]
    fn a_tail_at_depth_is_the_jobs() {
        let job = [[0.0, 0.0, -5.0], [10.0, 0.0, -5.0], [10.0, 0.0, 5.0]];
        let leaves = |program: &[[f64; 3]]| leaves_low(&path(&job), &path(program), 1e-4).is_some();
        assert!(!leaves(&[job[0], [5.0, 0.0, -5.0], job[1], job[2], [30.0, 0.0, 5.0]]));
        assert!(leaves(&[job[0], [5.0, 0.0, -5.0], [5.0, 0.0, 5.0], job[2]]));
        assert!(leaves(&[job[0], [30.0, 0.0, -5.0], [30.0, 0.0, 5.0]]));
    }
}
