//! The moves at one point of a cycle, from the numbered lists of the CYCLE chapter.

use super::cycle::{Cycle, Kind};
use super::{Point, Turn};

/// A height, or a range of heights if no word of the cycle defines it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Height {
    /// The lowest.
    pub from: f64,
    /// The highest.
    pub to: f64,
}

impl Height {
    fn at(z: f64) -> Height {
        Height { from: z, to: z }
    }

    /// Whether the height `z` is in the range, with a tolerance of `within` millimetres.
    pub fn holds(&self, z: f64, within: f64) -> bool {
        z >= self.from - within && z <= self.to + within
    }
}

/// A move or other action at a hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Move {
    /// A rapid: its X and Y, and its height. After a jog, X and Y differ from those of the hole. NaN: only a
    /// configuration defines the jog.
    Rapid([f64; 2], Height),
    /// A feed move to a height over the point, and its feed.
    Feed(f64, f64),
    /// A dwell in seconds; `None`: a configuration defines it.
    Dwell(Option<f64>),
    /// The spindle turns in this direction from here on.
    Spindle(Turn),
    /// The spindle is oriented to this angle.
    Orient(Option<f64>),
    /// A program stop.
    Stop,
}

/// A point of a cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// The type of the cycle.
    pub kind: Kind,
    /// The kind of pecks of a tap, if it pecks.
    pub pecks: Option<Kind>,
    /// X and Y of the hole.
    pub over: [f64; 2],
    /// Height of the tool over the hole before the first move: the clearance.
    pub clear: f64,
    /// Least height of the tool before and after the hole: the return plane or the clearance.
    pub plane: f64,
    /// The lowest height.
    pub bottom: f64,
    /// The moves, beginning at the clearance. The last rapid goes to the return plane.
    pub moves: Vec<Move>,
    /// Built-in cycles are allowed (CYCLE/AUTO).
    pub built_in: bool,
    /// Whether the hole is a tap that can't be made of single moves.
    pub rigid: bool,
    /// Whether the hole is a tap in the direction opposite to the spindle's direction.
    pub inverse: bool,
    /// The dwell at the bottom, if there is one; see [`Move::Dwell`].
    pub dwell: Option<Option<f64>>,
    /// The feed into the hole.
    pub feed: f64,
    /// Factor of the feed out of a tap.
    pub ratio: f64,
}

impl Hole {
    /// The same hole, lower by this distance: the next start of a thread.
    pub fn lower(&self, by: f64) -> Hole {
        let lowered = |part: &Move| match *part {
            Move::Feed(to, feed) if to == self.clear => Move::Feed(to - by, feed),
            other => other,
        };
        let moves = self.moves.iter().map(lowered).collect();
        let plane = if self.plane == self.clear { self.plane - by } else { self.plane };
        Hole { clear: self.clear - by, plane, moves, ..self.clone() }
    }
}

/// Largest second clearance if no word defines it, in millimetres: 0.1 inch.
const SECOND: f64 = 2.6;

/// The values, besides those of the cycle, that decide which moves are made at a point.
pub struct At {
    /// The point, in millimetres.
    pub point: Point,
    /// Millimetres in one unit of the file.
    pub unit: f64,
    /// The active clearance, in units of the file.
    pub clear: f64,
    /// The height of the return plane, in millimetres.
    pub plane: Option<f64>,
    /// The direction of the spindle.
    pub turn: Turn,
    /// The dwell in seconds, if the cycle dwells.
    pub dwell: Option<Option<f64>>,
    /// Built-in cycles are allowed (CYCLE/AUTO).
    pub built_in: bool,
}

/// The moves of a cycle at a point. `feed` gives the feed of each depth or step, in millimetres per minute. `None` if a
/// required word is missing.
pub fn hole(cycle: &Cycle, at: &At, feed: &dyn Fn(usize) -> Option<f64>) -> Option<Hole> {
    let [x, y, z] = at.point;
    let over = [x, y];
    let length = |value: f64| value * at.unit;
    let height = |below: f64| z - length(below);
    let clear = z + length(at.clear);
    // "If a control point is above the RETURN plane, the machine will simply retract to the regular clearance"
    let plane = at.plane.map_or(clear, |plane| plane.max(clear));
    let kind = kind(cycle, at);
    let depth = || cycle.depths.last()?.values.last().copied();
    // a tap against the spindle's direction: the chapter does not reverse the spindle before the tap
    if cycle.kind == Kind::Tap && cycle.is("INVERS") != (at.turn == Turn::Counterclockwise) {
        return None;
    }
    let mut moves = Vec::new();
    let mut bottom = z;
    let up = |moves: &mut Vec<Move>, to: f64| moves.push(Move::Rapid(over, Height::at(to)));
    if let (Some(down), true) = (cycle.rapto, kind != Kind::BoreBack) {
        up(&mut moves, clear - length(down));
    }
    let dwell = |moves: &mut Vec<Move>| moves.extend(at.dwell.map(Move::Dwell));
    let ratio = cycle.ratio.unwrap_or(1.0);
    let rigid = cycle.is("RIGID") || cycle.pecks.is_some();
    match kind {
        Kind::Drill | Kind::Face | Kind::Ream => {
            bottom = height(depth()?);
            moves.push(Move::Feed(bottom, feed(0)?));
            dwell(&mut moves);
            match kind {
                Kind::Ream => moves.push(Move::Feed(clear, feed(0)? * ratio)),
                _ => up(&mut moves, plane),
            }
        }
        Kind::Tap => {
            bottom = height(depth()?);
            moves.push(Move::Feed(bottom, feed(0)?));
            dwell(&mut moves);
            moves.push(Move::Spindle(at.turn.reversed()));
            moves.push(Move::Feed(clear, feed(0)? * ratio));
            moves.push(Move::Spindle(at.turn));
        }
        Kind::Bore => {
            bottom = height(depth()?);
            moves.push(Move::Feed(bottom, feed(0)?));
            dwell(&mut moves);
            match cycle.orient {
                None => {
                    moves.push(Move::Spindle(Turn::Off));
                    up(&mut moves, plane);
                }
                Some(angle) => {
                    let aside = aside(cycle, over, angle, at.unit);
                    moves.push(Move::Orient(angle));
                    moves.push(Move::Rapid(aside, Height::at(bottom + length(cycle.back.unwrap_or(0.0)))));
                    moves.push(Move::Rapid(aside, Height::at(plane)));
                    up(&mut moves, plane);
                }
            }
            moves.push(Move::Spindle(at.turn));
        }
        Kind::BoreBack => {
            let below = height(cycle.rapto?);
            bottom = height(depth()?);
            let aside = aside(cycle, over, cycle.orient.flatten(), at.unit);
            moves.push(Move::Orient(cycle.orient.flatten()));
            moves.push(Move::Rapid(aside, Height::at(clear)));
            moves.push(Move::Rapid(aside, Height::at(below)));
            up(&mut moves, below);
            moves.push(Move::Spindle(at.turn));
            moves.push(Move::Feed(bottom, feed(0)?));
            dwell(&mut moves);
            moves.push(Move::Orient(cycle.orient.flatten()));
            moves.push(Move::Rapid(aside, Height::at(bottom - length(cycle.back.unwrap_or(0.0)))));
            moves.push(Move::Rapid(aside, Height::at(plane)));
            up(&mut moves, plane);
            moves.push(Move::Spindle(at.turn));
        }
        Kind::Deep | Kind::Chips => {
            let depths = depths(cycle)?;
            let back = cycle.back.or(cycle.second).map(length);
            // "Rapid back down a distance f1-n below the control point", never above the clearance
            let again = |depth: f64| match back {
                Some(back) => Height::at((height(depth) + back).min(clear)),
                None => Height { from: height(depth), to: (height(depth) + SECOND).min(clear) },
            };
            for (number, &depth) in depths.iter().enumerate() {
                moves.push(Move::Feed(height(depth), feed(number)?));
                if number + 1 == depths.len() {
                    bottom = height(depth);
                    break;
                }
                let full = match (kind, cycle.times) {
                    (Kind::Deep, _) => true,
                    (_, Some(times)) => (number + 1) % times.max(1.0) as usize == 0,
                    _ => false,
                };
                if full {
                    up(&mut moves, clear);
                }
                moves.push(Move::Rapid(over, again(depth)));
            }
            dwell(&mut moves);
            up(&mut moves, plane);
        }
        Kind::Thru => {
            let values = &cycle.depths.last()?.values;
            bottom = height(values[0]);
            moves.push(Move::Feed(bottom, feed(0)?));
            for pair in values[1..].chunks(2) {
                let [start, end] = pair else { return None };
                let begin = match cycle.back.or(cycle.second) {
                    Some(back) => Height::at((height(*start) + length(back)).min(bottom)),
                    None => Height { from: height(*start), to: (height(*start) + SECOND).min(bottom) },
                };
                moves.push(Move::Rapid(over, begin));
                bottom = height(*end);
                moves.push(Move::Feed(bottom, feed(0)?));
            }
            dwell(&mut moves);
            up(&mut moves, plane);
        }
        Kind::Sink => {
            let [Some(outside), Some(angle), inside] = cycle.sink else { return None };
            let cone = |diameter: f64| diameter / 2.0 / (angle / 2.0).to_radians().tan();
            bottom = height(cone(outside));
            if let Some(inside) = inside {
                // "plunge the tool at a rapid rate to a calculated point clear of the original hole"
                moves.push(Move::Rapid(over, Height { from: height(cone(inside)), to: clear }));
            }
            moves.push(Move::Feed(bottom, feed(0)?));
            dwell(&mut moves);
            up(&mut moves, plane);
        }
        Kind::Manual => moves.push(Move::Stop),
    }
    Some(Hole {
        kind,
        pecks: cycle.pecks,
        over,
        clear,
        plane: if kind == Kind::Manual { clear } else { plane },
        bottom,
        moves,
        built_in: at.built_in,
        rigid: rigid && kind == Kind::Tap,
        inverse: cycle.is("INVERS"),
        dwell: at.dwell,
        feed: if kind == Kind::Manual { 0.0 } else { feed(0)? },
        ratio,
    })
}

/// The type by which the cycle is made: FACE for DRILL with a dwell and for TAP with NOREVR, DRILL for TAP with RAPOUT.
fn kind(cycle: &Cycle, at: &At) -> Kind {
    let kind = match cycle.kind {
        Kind::Tap if cycle.is("NOREVR") => Kind::Face,
        Kind::Tap if cycle.is("RAPOUT") => Kind::Drill,
        kind => kind,
    };
    if kind == Kind::Drill && at.dwell.is_some() { Kind::Face } else { kind }
}

/// The jogged position beside the hole. The tip points along the angle, so the tool moves in the opposite direction.
fn aside(cycle: &Cycle, over: [f64; 2], angle: Option<f64>, unit: f64) -> [f64; 2] {
    let jog = match (cycle.offset.as_slice(), cycle.second) {
        ([x, y], _) => return [over[0] - x * unit, over[1] - y * unit],
        ([jog], _) => jog * unit,
        ([], Some(jog)) => jog * unit,
        _ => f64::NAN,
    };
    let (sin, cos) = angle.unwrap_or(f64::NAN).to_radians().sin_cos();
    [over[0] - jog * cos, over[1] - jog * sin]
}

/// Depths of all pecks below the point, in units of the file.
fn depths(cycle: &Cycle) -> Option<Vec<f64>> {
    if cycle.steps.is_empty() {
        let depths: Vec<f64> = cycle.depths.iter().flat_map(|group| group.values.clone()).collect();
        // a single depth is the total depth, not a peck
        return (depths.len() > 1).then_some(depths);
    }
    let total = *cycle.depths.last()?.values.last()?;
    let steps: Vec<f64> = cycle.steps.iter().flat_map(|group| group.values.clone()).collect();
    let mut step = *steps.last()?;
    let mut reached = 0.0;
    let mut list = Vec::new();
    while list.len() < 10_000 {
        let next = match steps.get(list.len()) {
            Some(own) => *own,
            None => {
                // "the last repeated step value will be reduced by the DECR amount at each peck"
                step = (step - cycle.decrement.unwrap_or(0.0)).max(cycle.least.unwrap_or(0.0));
                step
            }
        };
        if next <= 0.0 {
            return None;
        }
        reached += next;
        if reached >= total - 1e-9 {
            list.push(total);
            return Some(list);
        }
        list.push(reached);
    }
    None
}
