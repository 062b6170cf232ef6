//! Paths of rapids between two cuts.

use super::cut::{ACROSS, ALL, Place, Rapid, distance, lies_between, same, turned_otherwise};
use super::tables::ANGLE;

/// Minimum length of a rapid, as a multiple of the tolerance. The direction of a shorter rapid can't be determined from
/// its printed digits.
const LEG: f64 = 4.0;

/// A path as a list of corners: its start, if known, and the ends of its rapids.
#[derive(Debug, Default)]
pub(super) struct RapidPath {
    pub corners: Vec<Rapid>,
    /// Whether the first corner is the start of the path.
    pub begun: bool,
}

impl RapidPath {
    /// Sets the path to these rapids from a start. Rapids without a move are left out.
    pub fn set(&mut self, start: Option<Rapid>, rapids: &[Rapid], tolerance: f64) {
        self.corners.clear();
        self.corners.extend(start);
        self.begun = start.is_some();
        for rapid in rapids {
            // a full turn of a rotary axis is a move
            let stays = |last: &Rapid| last.to.iter().zip(&rapid.to).all(|(a, b)| (a - b).abs() <= tolerance * 1e-3);
            if !self.corners.last().is_some_and(|last| stays(last) && last.unknown == rapid.unknown) {
                self.corners.push(*rapid);
            }
        }
    }

    /// Joins the parts of a straight rapid if no state of the spindle is required between the parts.
    pub fn join(&mut self, tolerance: f64) {
        // the direction of a rapid as short as the tolerance is unknown
        let leads = |a: &Rapid, b: &Rapid| distance(&a.to, &b.to) > LEG * tolerance;
        let mut kept = 0;
        for at in 0..self.corners.len() {
            let corner = self.corners[at];
            if let [.., before, last] = &self.corners[..kept]
                && leads(before, last)
                && leads(last, &corner)
                && (last.spin.is_none() || last.spin == corner.spin)
                && (before.unknown | last.unknown | corner.unknown) == 0
                && lies_between(&before.to, &last.to, &corner.to, tolerance)
            {
                kept -= 1;
            }
            self.corners[kept] = corner;
            kept += 1;
        }
        self.corners.truncate(kept);
    }

    /// Whether both paths have the same corners with the same unknown axes.
    pub fn is(&self, other: &RapidPath, tolerance: f64) -> bool {
        self.corners.len() == other.corners.len()
            && self
                .corners
                .iter()
                .zip(&other.corners)
                .all(|(a, b)| a.unknown == b.unknown && same(&a.to, &b.to, ALL & !a.unknown, tolerance))
    }

    /// Whether all rapids across are above this height.
    pub fn stays_above(&self, height: f64) -> bool {
        across(&self.corners, 0.0).all(|(a, b)| a.height() > height && b.height() > height)
    }
}

/// Whether the rotary axes turn by the same turns on two paths whose corners are equal except for full turns.
pub(super) fn turn_alike(a: &[Rapid], b: &[Rapid]) -> bool {
    let pairs = a.windows(2).zip(b.windows(2));
    pairs.into_iter().all(|(a, b)| {
        turned_otherwise([&a[0].to, &a[1].to], [&b[0].to, &b[1].to]) & !(a[0].unknown | a[1].unknown) == 0
    })
}

/// The program's first rapid that turns the part through angles through which the job does not turn it on this path:
/// the end of the rapid, and as bits the axes that turn it. Above the start of the path, and not below the job's greatest height, the part may turn in any way.
pub(super) fn turned_low(job: &[Rapid], program: &[Rapid], tolerance: f64) -> Option<(Place, u8)> {
    let start = job.first()?.height();
    let highest = highest(job);
    let is_free = |a: &Rapid, b: &Rapid| {
        let low = a.height().min(b.height());
        low >= highest - tolerance && low > start + tolerance
    };
    let turns_as_job = |a: &Rapid, b: &Rapid, axis: usize| {
        let (low, high) = (a.to[axis].min(b.to[axis]), a.to[axis].max(b.to[axis]));
        let angles = || job.iter().filter(|corner| corner.unknown & 1 << axis == 0).map(|corner| corner.to[axis]);
        let (from, to) = (angles().fold(f64::INFINITY, f64::min), angles().fold(f64::NEG_INFINITY, f64::max));
        let slack = 2.0 * ANGLE.max(tolerance);
        // the program may count its angles from another turn
        let turns = 360.0 * ((from - slack - low) / 360.0).ceil();
        (a.unknown | b.unknown) & 1 << axis != 0 || high - low <= slack || high + turns <= to + slack
    };
    let low = program.windows(2).filter(|pair| !is_free(&pair[0], &pair[1])).map(|pair| {
        let otherwise = (3..6).filter(|&axis| !turns_as_job(&pair[0], &pair[1], axis));
        (pair[1].to, otherwise.map(|axis| 1 << axis).sum())
    });
    low.into_iter().find(|(_, axes)| *axes != 0)
}

/// The greatest known height of a path, or infinity if no height is known.
pub(super) fn highest(corners: &[Rapid]) -> f64 {
    known_heights(corners).reduce(f64::max).unwrap_or(f64::INFINITY)
}

/// The lowest height of the moves across of a path. Without moves across, the greatest height.
pub(super) fn crossing(corners: &[Rapid], tolerance: f64) -> f64 {
    let heights = across(corners, tolerance).map(|(a, b)| a.height().min(b.height()));
    heights.reduce(f64::min).unwrap_or_else(|| highest(corners))
}

/// The lowest height of the moves across to machine positions, if there are such moves.
pub(super) fn home_crossing(corners: &[Rapid], tolerance: f64) -> Option<f64> {
    let home = across(corners, tolerance).filter(|(_, to)| to.unknown & ACROSS != 0);
    home.map(|(a, b)| a.height().min(b.height())).reduce(f64::min)
}

/// The heights of the corners whose height is not known only at the machine.
pub(super) fn known_heights<'a>(corners: impl IntoIterator<Item = &'a Rapid>) -> impl Iterator<Item = f64> {
    corners.into_iter().map(Rapid::height).filter(|height| height.is_finite())
}

/// The moves between two corners, without the moves that change only Z.
pub(super) fn across(corners: &[Rapid], tolerance: f64) -> impl Iterator<Item = (&Rapid, &Rapid)> {
    let pairs = corners.windows(2).map(|pair| (&pair[0], &pair[1]));
    // a full turn of a rotary axis is a move, although it ends where it began
    let turns = |a: &Rapid, b: &Rapid| (3..6).any(|axis| (a.to[axis] - b.to[axis]).abs() > 0.001);
    // a move to or from a machine position
    let home = |a: &Rapid, b: &Rapid| (a.unknown ^ b.unknown) & ACROSS != 0;
    pairs.filter(move |(a, b)| !same(&a.to, &b.to, ACROSS, tolerance) || turns(a, b) || home(a, b))
}
