//! The transition between two moves.

use super::piece::{NORMAL, PERIOD, Piece, TANGENTIAL, Vector};
use crate::times::corner::PathMode;
use crate::times::rates::{AxisRates, Rates, size};

/// A kink between two moves may use this share of the acceleration. Below this share, the moves count as tangent.
const KINK: f64 = 0.1;
/// Angle in radians: the tool reverses if two directions are within two degrees of opposite.
const BACK: f64 = 2.0 * std::f64::consts::PI / 180.0;
/// If the rest of a move takes fewer servo periods than this, the rest becomes part of the blend.
const LEAST_PERIODS: f64 = 4.0;

/// The transition between two moves.
pub(super) enum Joint {
    Stop,
    /// The moves continue without a stop, at most at this speed.
    Tangent(f64),
    /// The next move begins this many seconds before the end of the move before it.
    Overlap(f64),
    /// An arc of this length is inserted. Both moves are already shortened for the arc.
    Arc {
        length: f64,
        speed: f64,
        acceleration: f64,
        swallows: bool,
    },
}

/// Finds the transition between two moves, and shortens the moves for it.
pub(super) fn joint(last: &mut Piece, next: &mut Piece, mode: PathMode, rates: &Rates) -> Joint {
    let (before, after) = (last.directions[1], next.directions[0]);
    let together: Vector = std::array::from_fn(|axis| before[axis] + after[axis]);
    let turns = [before, after].contains(&[0.0; 3]);
    if mode == PathMode::Stop || last.is_cut != next.is_cut || turns || size(&together) < BACK {
        return Joint::Stop;
    }
    // the jump of the speed of each axis within one servo period, as a share of the acceleration of the axis
    let slower = last.wanted.min(last.most).min(next.wanted.min(next.most));
    let jump = slower / PERIOD + next.acceleration;
    let share = |axis: usize| {
        rates.axes[axis].acceleration.map_or(0.0, |most| (after[axis] - before[axis]).abs() * jump / most)
    };
    let round = if last.round.is_some() || next.round.is_some() { 1.0 / TANGENTIAL } else { 1.0 };
    let kink = (0..3).map(share).fold(0.0, f64::max) * round;
    if kink < KINK {
        (last.kinks[1], next.kinks[0]) = (kink, kink);
        return Joint::Tangent(slower);
    }
    let through = slower * KINK / kink;
    let PathMode::Blend(tolerance) = mode else {
        (last.kinks[1], next.kinks[0]) = (KINK, KINK);
        return Joint::Stop;
    };
    let arc = arc(last, next, tolerance, rates);
    let (speed, early) = overlap(last, next, tolerance);
    let by_arc = arc.as_ref().map_or(0.0, |arc| arc.speed);
    match arc {
        Some(arc) if by_arc > speed / 2.0 && by_arc > through => {
            let rest = last.length - arc.trims[0];
            let swallows = last.round.is_none() && !last.begins_in_overlap && rest / arc.speed < LEAST_PERIODS * PERIOD;
            last.length = rest.max(1e-9);
            next.length = (next.length - arc.trims[1]).max(1e-9);
            let length = arc.length + if swallows { rest.max(0.0) } else { 0.0 };
            Joint::Arc { length, speed: arc.speed, acceleration: arc.acceleration, swallows }
        }
        _ if speed / 2.0 >= through => {
            next.begins_in_overlap = true;
            Joint::Overlap(early)
        }
        _ => {
            (last.kinks[1], next.kinks[0]) = (KINK, KINK);
            Joint::Tangent(through)
        }
    }
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Half of the angle inside the corner.
fn half_angle(last: &Piece, next: &Piece) -> f64 {
    (-dot(&last.directions[1], &next.directions[0])).clamp(-1.0, 1.0).acos() / 2.0
}

/// For a parabolic blend: the speed through the corner, and the time by which the next move begins early.
fn overlap(last: &Piece, next: &Piece, tolerance: Option<f64>) -> (f64, f64) {
    let half = half_angle(last, next);
    // in a blend, both moves have half of their acceleration
    let halved = |piece: &Piece| {
        let mut piece = piece.clone();
        piece.begins_in_overlap = true;
        piece.along()
    };
    let (a1, a2) = (halved(last), halved(next));
    let reached =
        |piece: &Piece, a: f64, share: f64| (a * piece.length * share).sqrt().min(piece.wanted.min(piece.most));
    let speeds = |share: f64| {
        let (mut v1, mut v2) = (reached(last, a1, share), reached(next, a2, share));
        let whole = (last.length / v1).min(next.length / v2);
        let time = whole.min((v1 / a1).max(v2 / a2));
        (v1, v2) = (v1.min(time * a1), v2.min(time * a2));
        if let Some(tolerance) = tolerance.filter(|tolerance| *tolerance > 0.0 && half.cos() > 1e-3) {
            let within = 2.0 * (a1 * tolerance / half.cos()).sqrt();
            (v1, v2) = (v1.min(within), v2.min(within));
        }
        (v1, v2)
    };
    // the speeds at the other ends of the moves are not known yet: half of each move is reserved for them
    let (v1, v2) = speeds(0.5);
    (half.sin() * (v1 + v2) / 2.0, speeds(1.0).0 / a1)
}

/// An arc between two moves.
struct Arc {
    length: f64,
    speed: f64,
    acceleration: f64,
    /// The length by which each move is shortened.
    trims: [f64; 2],
}

/// The arc to insert; `None`: no arc is possible.
fn arc(last: &Piece, next: &Piece, tolerance: Option<f64>, rates: &Rates) -> Option<Arc> {
    let (before, after) = (last.directions[1], next.directions[0]);
    let mut half = half_angle(last, next);
    if !(1e-6..std::f64::consts::FRAC_PI_2 - 1e-6).contains(&half) {
        return None;
    }
    let normal = cross(&before, &after);
    let normal = normal.map(|part| part / size(&normal));
    let flat = |piece: &Piece| piece.round.is_none_or(|round| dot(&normal, &round.axis).abs() > 1.0 - 1e-9);
    if !flat(last) || !flat(next) {
        return None;
    }
    let within = tolerance.filter(|tolerance| *tolerance > 0.0).unwrap_or(f64::INFINITY);
    let within = within.min(last.nominal / 4.0).min(next.nominal / 4.0);
    let whole = half;
    // the length that the arc may take from each move; a move that curves towards the other one makes the corner sharper
    let mut room = |piece: &Piece, other: &Vector, at: usize, share: f64, of_line: f64| {
        let Some(round) = piece.round else { return of_line };
        let towards = dot(&round.inwards[at], other) * if at == 1 { 1.0 } else { -1.0 } > 0.0;
        let most = (round.sweep * share).min(if towards { whole } else { std::f64::consts::FRAC_PI_2 });
        if !towards {
            return most * round.radius;
        }
        half = half.min(whole - most / 4.0);
        (most / 4.0).sin() * round.radius
    };
    let first = room(last, &after, 1, 2.0 / 3.0, last.length.min(last.nominal / 2.0));
    let second = room(next, &before, 0, 1.0 / 3.0, next.length / 2.0);
    if half <= 0.0 || last.round.is_some() && next.round.is_some() && half < std::f64::consts::PI / 12.0 {
        return None;
    }
    let turn = std::f64::consts::PI - 2.0 * half;
    let in_plane = |of: fn(&AxisRates) -> Option<f64>| {
        // the greatest value in the plane of the corner that no axis exceeds
        let along = |axis: usize| (1.0 - normal[axis] * normal[axis]).max(0.0).sqrt().max(1e-12);
        (0..3).filter_map(|axis| Some(of(&rates.axes[axis])? / along(axis))).fold(f64::INFINITY, f64::min)
    };
    let strongest = in_plane(|axis| axis.acceleration);
    let fastest = in_plane(|axis| axis.rapid);
    let across = strongest * NORMAL;
    let wanted = last.wanted.min(last.most).max(next.wanted.min(next.most));
    let goal = wanted.min(altitude(last, next, turn).max(fastest));
    let reach = first.min(second).min(within * half.cos() / (1.0 - half.sin()));
    let widest = half.tan() * reach;
    let speed = (across * widest).sqrt().min(goal);
    let along = strongest * TANGENTIAL;
    let ramp = (2.0 * along * reach).sqrt().min(speed) / along * speed;
    let radius = (speed * speed / across).max((ramp / turn).min(widest));
    if radius < 1e-12 || radius * turn < 1e-6 {
        return None;
    }
    let trim = radius / half.tan();
    Some(Arc {
        length: radius * turn,
        speed,
        acceleration: along,
        trims: [trim.min(last.length), trim.min(next.length)],
    })
}

/// The greatest speed through the corner between two lines. At this speed, both lines keep their speed limits.
fn altitude(last: &Piece, next: &Piece, turn: f64) -> f64 {
    if last.round.is_some() || next.round.is_some() {
        return 0.0;
    }
    let angle = turn.min(std::f64::consts::PI * 0.49);
    let first = last.most.min(next.most / angle.cos());
    let second = next.most.min(last.most / angle.cos());
    let base: Vector = std::array::from_fn(|axis| next.directions[0][axis] * second - last.directions[1][axis] * first);
    let base = size(&base);
    if base > 0.0 { first * second * turn.sin() / base } else { 0.0 }
}
