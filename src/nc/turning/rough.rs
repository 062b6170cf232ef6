//! Calculates the passes that remove the stock outside a profile. The functions of this file only convert a profile to
//! moves.

use super::MOST;
use crate::diag::Code;
use crate::nc::fault::{Done, refuse};
use crate::nc::profiled::How;

/// A point: the radius, then Z.
pub(super) type Point = [f64; 2];

/// A piece of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// End of the piece.
    pub to: Point,
    /// The centre of an arc, and whether the arc is counterclockwise from Z to X; `None`: the piece is straight.
    pub arc: Option<(Point, bool)>,
}

/// A profile: the first move from the start of the cycle, then the cuts.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Profile {
    /// Whether the first move is a rapid.
    pub rapid: bool,
    /// End of the first move.
    pub begin: Point,
    /// The cuts.
    pub pieces: Vec<Piece>,
}

/// A move of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Move {
    Rapid(Point),
    Cut(Piece),
}

/// Positions that differ by less than this are equal.
const SAME: f64 = 1e-7;

/// The moves of a cycle that begins and ends at `start`.
pub(super) fn moves(profile: &Profile, start: Point, how: &How) -> Done<Vec<Move>> {
    match *how {
        How::Finish => Ok(Vec::new()),
        How::Pattern { outside, count, left } => Ok(pattern(profile, start, outside, count, left)),
        How::Passes { across, depth, back, left } => {
            // for passes along X, the profile is mirrored so that the passes are along Z: X and Z are exchanged, and
            // arcs change their direction
            let turned = |point: Point| if across { [point[1], point[0]] } else { point };
            let piece = |piece: &Piece| Piece {
                to: turned(piece.to),
                arc: piece.arc.map(|(centre, ccw)| (turned(centre), ccw != across)),
            };
            let shape = Profile {
                rapid: profile.rapid,
                begin: turned(profile.begin),
                pieces: profile.pieces.iter().map(piece).collect(),
            };
            let list = passes(&shape, turned(start), depth, back, turned(left), across)?;
            Ok(list
                .iter()
                .map(|step| match step {
                    Move::Rapid(to) => Move::Rapid(turned(*to)),
                    Move::Cut(cut) => Move::Cut(piece(cut)),
                })
                .collect())
        }
    }
}

fn moved(point: Point, by: Point) -> Point {
    [point[0] + by[0], point[1] + by[1]]
}

fn shifted(piece: &Piece, by: Point) -> Piece {
    Piece { to: moved(piece.to, by), arc: piece.arc.map(|(centre, ccw)| (moved(centre, by), ccw)) }
}

fn first(profile: &Profile, to: Point) -> Move {
    if profile.rapid { Move::Rapid(to) } else { Move::Cut(Piece { to, arc: None }) }
}

/// G73: passes along the whole profile, each nearer to the final shape.
fn pattern(profile: &Profile, start: Point, outside: Point, count: u32, left: Point) -> Vec<Move> {
    let mut list = Vec::new();
    for pass in 0..count {
        let share = if count == 1 { 0.0 } else { f64::from(count - 1 - pass) / f64::from(count - 1) };
        let by = [outside[0] * share + left[0], outside[1] * share + left[1]];
        list.push(Move::Rapid(moved(start, by)));
        list.push(first(profile, moved(profile.begin, by)));
        list.extend(profile.pieces.iter().map(|piece| Move::Cut(shifted(piece, by))));
    }
    list.push(Move::Rapid(start));
    list
}

/// G71 and G72: passes along the second coordinate, each deeper along the first coordinate. The last pass follows the
/// profile, with the allowance for the finish. Only profiles of type I are run: a profile whose direction reverses is
/// refused.
fn passes(profile: &Profile, start: Point, depth: f64, back: f64, left: Point, across: bool) -> Done<Vec<Move>> {
    let inwards = (profile.begin[0] - start[0]).signum();
    let last = profile.pieces.last().map_or(profile.begin, |piece| piece.to);
    let onwards = (last[1] - profile.begin[1]).signum();
    let [deep, along] = if across { ["Z", "X"] } else { ["X", "Z"] };
    let code = if across { "G72" } else { "G71" };
    if (profile.begin[0] - start[0]).abs() < SAME {
        let message =
            format!("{code}: the profile begins at the {deep} of the cycle's start: there is no material to remove");
        return refuse(
            Code::PN018,
            message,
            format!("in the first block of the profile, move to the {deep} where the profile begins"),
        );
    }
    let beyond = |piece: &&Piece| (piece.to[0] - start[0]) * inwards < -SAME;
    if profile.pieces.iter().any(|piece| beyond(&piece)) {
        let message = format!(
            "{code}: the profile goes farther out than the start of the cycle: the control cuts that part in one \
                pass"
        );
        return refuse(Code::PN018, message, format!("begin at the {deep} of the stock, outside the whole profile"));
    }
    let mut from = profile.begin;
    for piece in &profile.pieces {
        let ends = [[from[0], piece.to[0]], [from[1], piece.to[1]]];
        let goes_on = |axis: usize, sense: f64| {
            (ends[axis][1] - ends[axis][0]) * sense >= -SAME && bulges(from, piece, axis, -sense) <= SAME
        };
        for (axis, sense, name) in [(0, -inwards, deep), (1, onwards, along)] {
            if !goes_on(axis, sense) {
                let message =
                    format!("{code}: the profile goes back along {name}: controls differ in how they cut such pockets");
                return refuse(Code::PN016, message, "cut the pocket with a separate cycle, or write its moves");
            }
        }
        from = piece.to;
    }
    let clear = moved(start, left);
    let (begin, pieces) = (moved(profile.begin, left), profile.pieces.iter().map(|piece| shifted(piece, left)));
    let pieces: Vec<Piece> = pieces.collect();
    // if the last level differs from the beginning of the profile only by rounding, it is not a separate pass
    let count = (((begin[0] - clear[0]).abs() - SAME) / depth).ceil();
    if count > MOST {
        return refuse(Code::PN018, format!("{code} of more than {MOST} passes"), "write a larger depth");
    }
    let mut list = Vec::new();
    if left != [0.0; 2] {
        list.push(Move::Rapid(clear));
    }
    let infeed = |level: f64| first(profile, [level, clear[1]]);
    // the last level is the beginning of the profile, so its pass follows the profile to the end
    for pass in 1..count as u32 {
        let level = clear[0] + inwards * depth * f64::from(pass);
        let end = crossing(begin, &pieces, level, inwards);
        list.push(infeed(level));
        if (end - clear[1]).abs() < SAME {
            continue;
        }
        list.push(Move::Cut(Piece { to: [level, end], arc: None }));
        let away = (clear[1] - end).signum() * back.min((clear[1] - end).abs());
        list.push(Move::Rapid([level - inwards * back, end + away]));
        list.push(Move::Rapid([level - inwards * back, clear[1]]));
    }
    list.push(first(profile, begin));
    list.extend(pieces.into_iter().map(Move::Cut));
    list.push(Move::Rapid(start));
    Ok(list)
}

/// The distance by which an arc extends beyond its ends along an axis, in the direction of `sense`.
fn bulges(from: Point, piece: &Piece, axis: usize, sense: f64) -> f64 {
    let Some((centre, ccw)) = piece.arc else { return 0.0 };
    let radius = (from[0] - centre[0]).hypot(from[1] - centre[1]);
    // angles are measured from Z towards X
    let angle = |point: Point| (point[0] - centre[0]).atan2(point[1] - centre[1]);
    let turn = if ccw { 1.0 } else { -1.0 };
    let sweep = (turn * (angle(piece.to) - angle(from))).rem_euclid(std::f64::consts::TAU);
    let mut peak = [0.0; 2];
    peak[axis] = sense;
    let ahead = (turn * (peak[0].atan2(peak[1]) - angle(from))).rem_euclid(std::f64::consts::TAU);
    let most = (from[axis] * sense).max(piece.to[axis] * sense);
    if ahead < sweep { centre[axis] * sense + radius - most } else { 0.0 }
}

/// The second coordinate at which a pass at this level meets the profile. If the pass does not meet the profile, the
/// result is the last coordinate of the profile.
fn crossing(begin: Point, pieces: &[Piece], level: f64, inwards: f64) -> f64 {
    let mut from = begin;
    for piece in pieces {
        // the profile only goes outwards, so the pass ends where the profile first reaches the level
        if (piece.to[0] - level) * inwards <= SAME {
            return meets(from, piece, level);
        }
        from = piece.to;
    }
    from[1]
}

fn meets(from: Point, piece: &Piece, level: f64) -> f64 {
    match piece.arc {
        None if (piece.to[0] - from[0]).abs() < SAME => from[1],
        None => from[1] + (piece.to[1] - from[1]) * (level - from[0]) / (piece.to[0] - from[0]),
        Some((centre, _)) => {
            let radius = (from[0] - centre[0]).hypot(from[1] - centre[1]);
            let half = (radius * radius - (level - centre[0]).powi(2)).max(0.0).sqrt();
            let [low, high] = [from[1].min(piece.to[1]), from[1].max(piece.to[1])];
            let beyond = |at: &f64| (low - at).max(at - high).max(0.0);
            let both = [centre[1] - half, centre[1] + half];
            if beyond(&both[0]) <= beyond(&both[1]) { both[0] } else { both[1] }
        }
    }
}
