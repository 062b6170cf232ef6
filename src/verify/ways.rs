//! Compares the program's path from one cut to the next with the job's path.

use super::cut::{ACROSS, ALL, DEPTH, Place, Rapid, Spin, lies_between, number, same, without_turns};
use super::rapid_path::{RapidPath, across, crossing, highest, home_crossing, known_heights, turn_alike, turned_low};

/// The result of comparing the program's path with the job's path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Compared {
    /// The program has the job's path. The program may have additional moves without a length, and may divide straight
    /// rapids into parts.
    Same,
    /// The path moves the axes in another order, or is higher than the job's path, but is nowhere lower.
    /// `step_by_step`: each move of the program in X or Y corresponds to a move of the job in X or Y.
    AsGood { step_by_step: bool },
    /// The path is lower than the job's path.
    Lower(Low),
    /// The path moves across to this position, to which the job does not go.
    Elsewhere(Rapid),
    /// At the height of the cuts, a rapid to this position turns the part by these axes in another direction than the
    /// job, or by more turns.
    Turned(Place, u8),
    /// The program has the job's path, but the spindle is in another state than the job requires.
    Turning,
}

/// A rapid of the program that is too low.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Low {
    /// The end of the rapid.
    pub to: Rapid,
    /// The lowest height of the rapid.
    pub height: f64,
    /// The lowest height that is allowed.
    pub limit: f64,
}

impl Low {
    /// The message about a rapid before a cut.
    pub fn message(&self) -> String {
        let Rapid { to, unknown, .. } = self.to;
        let (begin, limit) = (number(self.height), number(self.limit));
        let end = self.to.text();
        if begin >= limit && self.to.is_at_machine(0b11) {
            return format!(
                "a rapid goes to a machine position in X or Y at Z{begin}, but the job stays over the part here"
            );
        }
        if begin >= limit {
            return format!("a rapid goes down to {end}, but the job goes down at another X or Y here");
        }
        let is_lower = unknown & 1 << DEPTH != 0 || begin < number(to[DEPTH]);
        let from = if is_lower { format!("from Z{begin} ") } else { String::new() };
        format!("a rapid goes {from}to {end}, which is below the job's rapids here, Z{limit}")
    }
}

/// Greatest length, as a multiple of the tolerance, of a rapid across that may be a rapid straight up with rounded
/// ends.
pub(super) const ROUNDED_ACROSS: f64 = 2.0;

/// Whether both paths have the same rapids with the same state of the spindle.
pub(super) fn are_the_same(job: &[Rapid], program: &[Rapid], tolerance: f64) -> bool {
    let is = |a: &Rapid, b: &Rapid| b.unknown == 0 && same(&a.to, &b.to, ALL, tolerance) && spins(a, b);
    job.len() == program.len() && job.iter().zip(program).all(|(a, b)| is(a, b)) && turn_alike(job, program)
}

/// Compares the program's path with the job's path, rapid by rapid. If the paths differ, joins the parts of straight
/// rapids in both paths and compares the joined paths.
pub(super) fn compare(job: &mut RapidPath, program: &mut RapidPath, known_start: bool, tolerance: f64) -> Compared {
    let by_rapids = compare_as_they_are(job, program, known_start, tolerance);
    if !matches!(by_rapids, Compared::Same | Compared::Turning | Compared::AsGood { step_by_step: true }) {
        job.join(tolerance);
        program.join(tolerance);
        let joined = compare_as_they_are(job, program, known_start, tolerance);
        if !matches!((by_rapids, joined), (Compared::AsGood { .. }, Compared::Lower(..) | Compared::Elsewhere(_))) {
            return joined;
        }
    }
    by_rapids
}

/// Compares the program's path with the job's without joining rapids.
///
/// If the starts of both paths are known, the heights at the ends of the moves across are compared. If the job's start
/// is unknown (after a tool change), the program may come to the job's first position from anywhere, but not lower than
/// that position.
fn compare_as_they_are(job: &RapidPath, program: &RapidPath, known_start: bool, tolerance: f64) -> Compared {
    if known_start && let Some((to, axes)) = turned_low(&job.corners, &program.corners, tolerance) {
        return Compared::Turned(to, axes);
    }
    if known_start && let Some((to, height)) = low_at_machine(&job.corners, &program.corners, tolerance) {
        return Compared::Lower(Low { to: *to, height, limit: highest(&job.corners) });
    }
    let Some(first) = job.corners.first().filter(|_| !known_start) else {
        return compare_corners(
            &job.corners,
            &program.corners,
            known_start,
            usize::from(!known_start && program.begun),
            tolerance,
        );
    };
    // at the X and Y of its first position, the job may go down before it goes across
    let over_it = job.corners.iter().take_while(|corner| same(&corner.to, &first.to, ACROSS, tolerance));
    let limit = known_heights([first]).next().unwrap_or_else(|| highest(&job.corners));
    let lowest = known_heights(over_it).fold(limit, f64::min);
    let there = |exactly: u8| {
        program.corners.iter().position(|corner| {
            corner.unknown & !first.unknown == 0
                && same(&corner.to, &first.to, exactly & !first.unknown, tolerance)
                && corner.height() >= lowest - tolerance
        })
    };
    let Some(arrived) = there(ALL).or_else(|| there(ACROSS)) else {
        return compare_corners(&job.corners, &program.corners, false, usize::from(program.begun), tolerance);
    };
    // the program's first corner is the end of the last cut
    let low = program.corners[..=arrived]
        .iter()
        .skip(usize::from(program.begun))
        .find(|corner| corner.height() < lowest - tolerance);
    let crosses =
        across(&program.corners[..=arrived], tolerance).find(|(a, b)| a.height().min(b.height()) < limit - tolerance);
    // before the tool comes down, X or Y, if known, must be that of the first position; if both are unknown, the
    // program printed the height first
    let astray = |corner: &&Rapid| {
        corner.unknown & 0b11 != 0b11
            && corner.height() <= limit + tolerance
            && !same(&corner.to, &first.to, 0b11 & !first.unknown, tolerance)
    };
    let astray = program.corners[..arrived].iter().skip(usize::from(program.begun)).find(astray);
    let at_end = |corner: &Rapid| (*corner, corner.height());
    let crosses = crosses.map(|(a, b)| (*b, a.height().min(b.height())));
    if let Some((to, height)) = low.map(at_end).or(crosses).or(astray.map(at_end)) {
        return Compared::Lower(Low { to, height, limit });
    }
    compare_corners(&job.corners, &program.corners[arrived..], true, 0, tolerance)
}

/// Whether the spindle at a corner of the program is in the state that the job requires. If the job requires no state,
/// any state is accepted.
fn spins(job: &Rapid, program: &Rapid) -> bool {
    job.spin.is_none_or(|wanted| program.spin.is_none_or(|is| is.serves(wanted)))
}

/// Whether the job requires a spindle that is stopped at an angle at this corner, but the program never stops the
/// spindle at this angle at the corner.
fn stands_otherwise(corner: &Rapid, program: &[Rapid], tolerance: f64) -> bool {
    let stands = matches!(corner.spin, Some(Spin::At(_) | Spin::Oriented));
    let mut there = program.iter().filter(|other| same(&other.to, &corner.to, ALL, tolerance)).peekable();
    stands && there.peek().is_some() && !there.any(|other| spins(corner, other))
}

/// Whether the spindle is in another state than required during the first rapid.
fn leaves_turning_otherwise(job: &[Rapid], program: &[Rapid], tolerance: f64) -> bool {
    let (Some(left), [start, first, ..]) = (job.get(1), program) else { return false };
    // if the tool left the hole at feed, it is already out
    let left_before = start.unknown == 0 && same(&start.to, &left.to, ALL, tolerance);
    !left_before && !spins(left, first)
}

/// Where a position lies on a straight rapid: the fraction of the rapid from 0 to 1, the point at this fraction, and
/// the lowest height of the rapid at this point if the positions are rounded. `None`: the position is not on the rapid.
fn along(place: &Place, from: &Place, to: &Place, tolerance: f64) -> Option<(f64, Place, f64)> {
    // a rotary axis is at the same position after a full turn
    let turns = |axis: usize| (3..6).contains(&axis);
    let way = |axis: usize| if turns(axis) { (to[axis] - from[axis]) % 360.0 } else { to[axis] - from[axis] };
    let longest = (0..6).filter(|&axis| axis != DEPTH).max_by(|&a, &b| way(a).abs().total_cmp(&way(b).abs()))?;
    let (far, whole) = (place[longest] - from[longest], way(longest));
    let far = if turns(longest) { far - 360.0 * ((far - whole / 2.0) / 360.0).round() } else { far };
    let part = (far / whole).clamp(0.0, 1.0);
    let there: Place = std::array::from_fn(|axis| from[axis] + part * way(axis));
    let steep = if whole == 0.0 { 0.0 } else { (way(DEPTH) / whole).abs() * tolerance };
    let lowest = (there[DEPTH] - steep).max(from[DEPTH].min(to[DEPTH]));
    same(place, &there, ACROSS, tolerance).then_some((part, there, lowest))
}

/// Whether a rapid across stays above the job's rapids everywhere and follows the lines of the job's rapids. It may
/// pass straight over corners between the job's rapids. A rapid whose start or end is unknown must be one of the job's
/// rapids.
pub(super) fn is_over(a: &Rapid, b: &Rapid, job: &[Rapid], tolerance: f64) -> bool {
    let is = |a: &Rapid, b: &Rapid| a.unknown == b.unknown && same(&a.to, &b.to, ALL & !a.unknown, tolerance);
    if (a.unknown | b.unknown) & ACROSS != 0 {
        return across(job, tolerance).any(|(c, d)| is(a, c) && is(b, d));
    }
    let highest = highest(job);
    let known = |end: &Rapid| {
        let mut place = end.to;
        place[DEPTH] = if end.height().is_infinite() { highest } else { place[DEPTH] };
        place
    };
    let [from, to] = [a, b].map(known);
    let is_end = |place: &Place| [from, to].iter().any(|end| same(end, place, ACROSS, tolerance));
    let crossed = job.iter().filter(|corner| !is_end(&corner.to));
    let mut stops: Vec<(f64, Place, f64)> = crossed.filter_map(|c| along(&c.to, &from, &to, tolerance)).collect();
    stops.sort_by(|a, b| a.0.total_cmp(&b.0));
    let over = |place: &Place, (c, d): (&Rapid, &Rapid)| {
        along(place, &known(c), &known(d), tolerance).is_some_and(|(_, _, lowest)| place[DEPTH] >= lowest - tolerance)
    };
    let places: Vec<Place> = [from].into_iter().chain(stops.iter().map(|stop| stop.1)).chain([to]).collect();
    places.windows(2).all(|piece| across(job, tolerance).any(|rapid| piece.iter().all(|end| over(end, rapid))))
}

/// The first rapid of the program from or to a machine position in X or Y that is not above the start of the job's path,
/// the end of the last cut: the end of the rapid, and its height. The part may be anywhere on the way to this position, so
/// only the job's own rapids may be that low.
pub(super) fn low_at_machine<'a>(job: &[Rapid], program: &'a [Rapid], tolerance: f64) -> Option<(&'a Rapid, f64)> {
    let start = job.first().map(Rapid::height).filter(|height| height.is_finite())?;
    let height = |a: &Rapid, b: &Rapid| a.height().min(b.height());
    let is_low = |(a, b): &(&Rapid, &Rapid)| {
        (a.is_at_machine(0b11) || b.is_at_machine(0b11))
            && height(a, b) <= start + tolerance
            && !is_over(a, b, job, tolerance)
    };
    across(program, tolerance).find(is_low).map(|(a, b)| (b, height(a, b)))
}

/// Compares two lists of corners. `start`: the number of corners at the start of the program's path that are the end of
/// the program's last cut.
fn compare_corners(job: &[Rapid], program: &[Rapid], known_start: bool, start: usize, tolerance: f64) -> Compared {
    if known_start && job.len() == program.len() {
        let pairs = || job.iter().zip(program);
        let is = |a: &Rapid, b: &Rapid| a.unknown == b.unknown && same(&a.to, &b.to, ALL & !a.unknown, tolerance);
        if pairs().all(|(a, b)| is(a, b)) {
            return if pairs().all(|(a, b)| spins(a, b)) { Compared::Same } else { Compared::Turning };
        }
    }
    let (highest, crossing) = (highest(job), crossing(job, tolerance));
    // at a position of the job, the path may be as low as the job is there; elsewhere it may be as low as the job's
    // moves across
    for corner in program.iter().skip(start) {
        // a corner of the job that gives only a height applies to any position
        let there =
            job.iter().filter(|other| other.unknown & 0b11 != 0 || same(&other.to, &corner.to, ACROSS, tolerance));
        let at_corners = known_heights(there).reduce(f64::min);
        let floor = at_corners.unwrap_or(crossing);
        if corner.height() >= floor - tolerance {
            continue;
        }
        // on a steep rapid, the rounding of X and Y changes the height
        let is_on = |(a, b): (&Rapid, &Rapid)| {
            (a.unknown | b.unknown) & 1 << DEPTH == 0
                && along(&corner.to, &a.to, &b.to, tolerance)
                    .is_some_and(|(_, _, lowest)| corner.height() >= lowest - tolerance)
        };
        if at_corners.is_none() || !across(job, tolerance).any(is_on) {
            return Compared::Lower(Low { to: *corner, height: corner.height(), limit: floor });
        }
    }
    // while the tool leaves, the spindle must be stopped, or stopped at its angle, if the job requires it
    let turns = known_start && leaves_turning_otherwise(job, program, tolerance)
        || job.iter().any(|corner| stands_otherwise(corner, program, tolerance));
    if known_start && across(job, tolerance).count() == across(program, tolerance).count() {
        let mut pairs = across(job, tolerance).zip(across(program, tolerance));
        let all = pairs.all(|((a, b), (c, d))| {
            same(&a.to, &c.to, ACROSS & !a.unknown, tolerance)
                && same(&b.to, &d.to, ACROSS & !b.unknown, tolerance)
                && c.height() >= a.height() - tolerance
                && d.height() >= b.height() - tolerance
        });
        if all {
            return if turns { Compared::Turning } else { Compared::AsGood { step_by_step: true } };
        }
    }
    if let Some(to) = goes_upright_elsewhere(job, program, highest, tolerance) {
        return Compared::Elsewhere(to);
    }
    // if the corners differ, no move across may be below the job's greatest height; if the job does not move across, the program must not
    // either
    let stays = across(job, tolerance).next().is_none();
    let home = home_crossing(job, tolerance);
    for (a, b) in across(program, ROUNDED_ACROSS * tolerance).filter(|(a, b)| !is_over(a, b, job, tolerance)) {
        let low = a.height().min(b.height());
        let goes_home_low = b.unknown & ACROSS != 0 && home.is_some_and(|home| low < home - tolerance);
        if low < highest - tolerance || goes_home_low || (stays && known_start && low.is_finite()) {
            let goes_there = job.iter().any(|corner| same(&corner.to, &b.to, ACROSS, tolerance));
            let lower = Low { to: *b, height: low, limit: highest };
            return if goes_there && !stays { Compared::Lower(lower) } else { Compared::Elsewhere(*b) };
        }
    }
    if turns { Compared::Turning } else { Compared::AsGood { step_by_step: false } }
}

/// The end of the first rapid straight up or down that is below the job's greatest height, at a position where the job
/// has no corner. An example is a boring bar that leaves its hole at another distance from the wall.
pub(super) fn goes_upright_elsewhere(job: &[Rapid], program: &[Rapid], highest: f64, tolerance: f64) -> Option<Rapid> {
    let is_there =
        |at: &Rapid| job.iter().any(|own| own.unknown & 0b11 != 0 || same(&own.to, &at.to, ACROSS, tolerance));
    let goes = |pair: &&[Rapid]| {
        let [a, b] = [&pair[0], &pair[1]];
        let is_upright = (a.unknown | b.unknown) & 0b11 == 0 && same(&a.to, &b.to, ACROSS, tolerance);
        is_upright && a.height().min(b.height()) < highest - tolerance && !is_there(b)
    };
    program.windows(2).find(goes).map(|pair| pair[1])
}

/// The position with full turns added to or subtracted from its angles, so that the angles are near the angles of
/// `like`.
fn unwound(place: &Place, like: &Place) -> Place {
    std::array::from_fn(|axis| match axis {
        3..6 => like[axis] + without_turns(place[axis] - like[axis]),
        _ => place[axis],
    })
}

/// Checks the path out of a hole whose cycle requires a state of the spindle, such as an angle. The path must contain
/// each corner for which the job requires a state, in the job's order and with this state.
pub(super) fn leaves_hole(job: &RapidPath, program: &RapidPath, tolerance: f64) -> Option<Compared> {
    let corners = &program.corners;
    let mut from = 0;
    for corner in job.corners.iter().skip(1).filter(|corner| corner.spin.is_some()) {
        let is = |at: &Rapid| at.unknown == 0 && same(&at.to, &corner.to, ALL, tolerance);
        // on a rapid to this corner, but not at the start of that rapid
        let passes = |at: usize| {
            at > 0
                && (corners[at - 1].unknown | corners[at].unknown) == 0
                && !is(&corners[at - 1])
                && lies_between(&corners[at - 1].to, &unwound(&corner.to, &corners[at].to), &corners[at].to, tolerance)
        };
        let there = || (from..corners.len()).filter(|&at| is(&corners[at]) || passes(at));
        match there().find(|&at| spins(corner, &corners[at])) {
            Some(at) => from = at,
            None if there().next().is_some() => return Some(Compared::Turning),
            None => return Some(Compared::AsGood { step_by_step: false }),
        }
    }
    None
}

/// Whether the program enters a hole with the same moves as the job, beginning above the hole. Moves away from the axis
/// of the hole must also be the same.
pub(super) fn enters_hole(job: &RapidPath, program: &RapidPath, over: &Place, tolerance: f64) -> bool {
    let Some(first) = job.corners.iter().position(|corner| same(&corner.to, over, ACROSS, tolerance)) else {
        return false;
    };
    let own = &job.corners[first..];
    let Some(begin) = program.corners.len().checked_sub(own.len()) else { return false };
    let mut pairs = own.iter().zip(&program.corners[begin..]);
    let comes_over = |(a, b): (&Rapid, &Rapid)| {
        same(&a.to, &b.to, ACROSS, tolerance) && b.unknown & ACROSS == 0 && b.height() >= a.height() - tolerance
    };
    pairs.next().is_some_and(comes_over)
        && pairs.all(|(a, b)| b.unknown == 0 && same(&a.to, &b.to, ALL, tolerance) && spins(a, b))
}

#[cfg(test)]
mod tests {
    use super::super::cut::place;
    use super::*;

    fn way_within(points: &[[f64; 3]], tolerance: f64) -> RapidPath {
        let rapids: Vec<Rapid> = points
            .iter()
            .map(|&[x, y, z]| Rapid { to: place(&[x, y, z, 0.0, 0.0, 0.0]), unknown: 0, kept: 0, spin: None })
            .collect();
        let mut way = RapidPath::default();
        way.set(None, &rapids, tolerance);
        way
    }

    fn way(points: &[[f64; 3]]) -> RapidPath {
        way_within(points, 1e-4)
    }

    fn compared(job: &[[f64; 3]], program: &[[f64; 3]]) -> Compared {
        compare(&mut way(job), &mut way(program), true, 1e-4)
    }

    #[test]
    fn parts_of_a_straight_rapid_are_the_jobs() {
        // the job's two rapids to the hole are on one line; the program goes across before it goes down
        let job = [[-1.0, -1.0, 7.0], [-0.5, -0.5, 5.0], [0.0, 0.0, 3.0]];
        let program = [[-1.0, -1.0, 7.0], [-0.5, -0.5, 5.0], [0.0, 0.0, 5.0], [0.0, 0.0, 3.0]];
        assert_eq!(compared(&job, &program), Compared::AsGood { step_by_step: true });
        let low = [[-1.0, -1.0, 7.0], [-0.5, -0.5, 4.9], [0.0, 0.0, 4.9], [0.0, 0.0, 3.0]];
        assert!(matches!(compared(&job, &low), Compared::Elsewhere(_) | Compared::Lower(..)));
        // the Y of the third corner is between those of the first two, but this corner is not on the rapid to the second one
        let back = [[0.0, 1.2, 0.7], [0.0, -2.7, 0.1], [0.0, -1.3, 0.1], [0.0, -1.6, -0.1]];
        let up = [
            [0.0, 1.2, 0.7],
            [0.0, -2.7, 0.7],
            [0.0, -2.7, 0.1],
            [0.0, -1.3, 0.1],
            [0.0, -1.6, 0.1],
            [0.0, -1.6, -0.1],
        ];
        assert_eq!(compared(&back, &up), Compared::AsGood { step_by_step: true });
        let on = [[0.0, 0.0, 9.0], [0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [8.0, 0.0, 3.0], [8.0, 0.0, 9.0], [9.0, 0.0, 9.0]];
        let straight = [[0.0, 0.0, 9.0], [0.0, 0.0, 5.0], [8.0, 0.0, 5.0], [8.0, 0.0, 9.0], [9.0, 0.0, 9.0]];
        assert_eq!(compared(&on, &straight), Compared::AsGood { step_by_step: false });
        // a rapid to a machine position at a low height
        let mut home = way(&job);
        home.corners.insert(2, Rapid { unknown: 0b11, ..home.corners[1] });
        assert!(matches!(compare(&mut way(&job), &mut home, true, 1e-4), Compared::Lower(..) | Compared::Elsewhere(_)));
        let beside = [[-1.0, -1.0, 7.0], [-0.5, -0.6, 5.0], [0.0, 0.0, 5.0], [0.0, 0.0, 3.0]];
        assert!(matches!(compared(&job, &beside), Compared::Elsewhere(_)));
    }

    #[test]
    fn another_order_of_axes_is_as_good_where_it_is_higher() {
        let diagonal = [[0.0, 0.0, 5.0], [9.0, 0.0, 1.0]];
        assert_eq!(compared(&diagonal, &diagonal), Compared::Same);
        assert_eq!(compared(&diagonal, &[[0.0, 0.0, 5.0], [4.5, 0.0, 3.0], [9.0, 0.0, 1.0]]), Compared::Same);
        assert_eq!(
            compared(&diagonal, &[[0.0, 0.0, 5.0], [9.0, 0.0, 5.0], [9.0, 0.0, 1.0]]),
            Compared::AsGood { step_by_step: true }
        );
        assert!(matches!(
            compared(&diagonal, &[[0.0, 0.0, 5.0], [0.0, 0.0, 1.0], [9.0, 0.0, 1.0]]),
            Compared::Lower(..)
        ));
        assert!(matches!(
            compared(&diagonal, &[[0.0, 0.0, 5.0], [3.0, 3.0, 2.0], [9.0, 0.0, 1.0]]),
            Compared::Elsewhere(..)
        ));
        assert!(matches!(
            compared(&diagonal, &[[0.0, 0.0, 5.0], [9.0, 0.0, 5.0], [9.0, 0.0, 0.5], [9.0, 0.0, 1.0]]),
            Compared::Lower(..)
        ));
    }

    /// A T-slot cutter leaves its slot at the end of the slot, and not before.
    #[test]
    fn a_rapid_straight_up_is_at_a_corner_of_the_job() {
        let job = [[0.0, 0.0, -5.0], [10.0, 0.0, -5.0], [10.0, 0.0, 5.0]];
        let before = [[0.0, 0.0, -5.0], [5.0, 0.0, -5.0], [5.0, 0.0, 5.0], [10.0, 0.0, 5.0]];
        assert!(
            matches!(compared(&job, &before), Compared::Elsewhere(to) if to.to == place(&[5.0, 0.0, 5.0, 0.0, 0.0, 0.0]))
        );
        let divided = [[0.0, 0.0, -5.0], [5.0, 0.0, -5.0], [10.0, 0.0, -5.0], [10.0, 0.0, 5.0]];
        assert!(matches!(compared(&job, &divided), Compared::Same | Compared::AsGood { .. }));
    }

    /// The path out of the hole is the same, although the job counts all turns of the rotary axis and the form
    /// subtracts full turns.
    #[test]
    fn a_hole_is_left_whatever_its_turns_are() {
        let p = |z: f64, a: f64, spin: Option<Spin>| Rapid {
            to: place(&[1.0, 2.0, z, a, 0.0, 0.0]),
            unknown: 0,
            kept: 0,
            spin,
        };
        let turns = Some(Spin::Turns(crate::nc::Rotation::Cw));
        let (mut job, mut program) = (RapidPath::default(), RapidPath::default());
        job.set(Some(p(-1.0, -390.0, None)), &[p(-0.2, -390.0, turns), p(1.4, -390.0, None)], 1e-4);
        program.set(Some(p(-1.0, -30.0, turns)), &[p(1.4, -30.0, turns)], 1e-4);
        assert_eq!(leaves_hole(&job, &program, 1e-4), None);
        program.set(Some(p(-1.0, -60.0, turns)), &[p(1.4, -60.0, turns)], 1e-4);
        assert!(leaves_hole(&job, &program, 1e-4).is_some());
    }

    /// On a steep rapid, the rounding of X and Y changes the height.
    #[test]
    fn home_before_an_index_behind_a_steep_rapid() {
        let p = |x: f64, y: f64, z: f64, b: f64, unknown: u8| Rapid {
            to: place(&[x, y, z, 0.0, b, 0.0]),
            unknown,
            kept: 0,
            spin: None,
        };
        let job = [
            p(-1.974702, -1.86326, 0.512099, 0.0, 0),
            p(-2.094636, -1.792214, 0.049581, 0.0, 0),
            p(-0.032124, 3.590409, 1.572302, 5.0, 0),
        ];
        let program = [
            p(-1.9747, -1.8633, 0.5121, 0.0, 0),
            p(-2.0946, -1.7922, 0.0496, 0.0, 0),
            p(-2.0946, -1.7922, 0.0, 0.0, 0b100),
            p(-2.0946, -1.7922, 0.0, 5.0, 0b100),
            p(-0.0321, 3.5904, 0.0, 5.0, 0b100),
            p(-0.0321, 3.5904, 1.5723, 5.0, 0),
        ];
        let mut ways = [RapidPath::default(), RapidPath::default()];
        ways[0].set(Some(job[0]), &job[1..], 1e-4);
        ways[1].set(Some(program[0]), &program[1..], 1e-4);
        let [own, made] = &mut ways;
        assert_eq!(compare(own, made, true, 1e-4), Compared::AsGood { step_by_step: false });
        // a corner on the path to a hole far below: because Y is rounded, the path looks straight
        let down = [[0.0, 0.072, 41.388], [0.0, 0.072, 41.363], [0.0, 2.972, -9.426]];
        let stays = [[0.0, 0.072, 41.388], [0.0, 0.072, 41.363], [0.0, 2.972, 41.363], [0.0, 2.972, -9.426]];
        let [mut job, mut program] = [way_within(&down, 2e-3), way_within(&stays, 2e-3)];
        assert!(matches!(compare(&mut job, &mut program, true, 2e-3), Compared::AsGood { .. }));
        made.corners[1].to[DEPTH] = 0.0494;
        assert!(matches!(compare(own, made, true, 1e-4), Compared::Lower(..)));
    }
}
