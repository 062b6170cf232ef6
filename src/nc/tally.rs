//! Statistics of a program: blocks, moves, holes, extents, distances and times.

use super::action::{Action, Item, Position, Turn};
use super::arcs::axes_of;
use super::pace::Pace;
use crate::toolpath::{Direction, Units};

/// Statistics of the actions of a program.
#[derive(Clone, Debug)]
pub struct Tally {
    /// Number of rapids, of straight feed moves, and of arcs.
    pub moves: [u64; 3],
    /// Number of holes of canned cycles.
    pub holes: u64,
    /// Number of tool changes.
    pub tools: u64,
    /// Total length of the rapids, and of the feed moves.
    pub distances: [f64; 2],
    /// Least and greatest X, Y, Z of the feed moves, including positions between the ends of a move.
    pub extents: Option<[(f64, f64); 3]>,
    /// Time of the feed moves at their programmed feeds, in minutes.
    pub cutting: f64,
    /// Time of dwells, in minutes.
    pub dwelling: f64,
    /// Number of feed moves with an unknown time: their feed depends on a spindle whose speed is not set.
    pub timeless: u64,
    /// Units of all lengths: the units that are active at the end.
    pub units: Units,
    at: Position,
    pace: Pace,
}

impl Tally {
    /// An empty tally.
    pub fn new(units: Units) -> Tally {
        Tally {
            moves: [0; 3],
            holes: 0,
            tools: 0,
            distances: [0.0; 2],
            extents: None,
            cutting: 0.0,
            dwelling: 0.0,
            timeless: 0,
            units,
            at: [0.0; 6],
            pace: Pace::new(f64::INFINITY),
        }
    }

    /// Adds an action.
    pub fn add(&mut self, item: &Item) {
        self.pace.takes(&item.action);
        match &item.action {
            Action::Rapid { to, machine, .. } => {
                self.moves[0] += 1;
                // the position in the program, and so the distance, is unknown for a move to a machine position
                if *machine == 0 {
                    self.distances[0] += distance(&self.at, to);
                }
                self.at = *to;
            }
            Action::Feed { to, feed, lead, .. } => {
                self.moves[1] += 1;
                let length = distance(&self.at, to);
                let radius = (self.at[0] + to[0]).abs() / 2.0;
                let turned = if length > 0.0 { 0.0 } else { turned(&self.at, to) };
                self.cut([length, turned], *feed, *lead, radius);
                self.reach(&self.at.clone());
                self.at = *to;
                self.reach(to);
            }
            Action::Arc(turn) => {
                self.moves[2] += 1;
                let radius = (self.at[0] + turn.to[0]).abs() / 2.0;
                self.cut([arc_length(&self.at, turn), 0.0], turn.feed, None, radius);
                self.reach(&self.at.clone());
                self.round(turn);
                self.at = turn.to;
                self.reach(&turn.to);
            }
            Action::Dwell(seconds) => self.dwelling += seconds / 60.0,
            Action::Tool(_) => self.tools += 1,
            Action::Hole(_) => self.holes += 1,
            Action::Units(units) if *units != self.units => {
                self.units = *units;
                let factor = if *units == Units::Inch { 1.0 / 25.4 } else { 25.4 };
                let lengths = self.distances.iter_mut().chain(&mut self.at[..3]);
                lengths.for_each(|length| *length *= factor);
                for (least, greatest) in self.extents.iter_mut().flatten() {
                    (*least, *greatest) = (*least * factor, *greatest * factor);
                }
            }
            _ => {}
        }
    }

    /// Minutes of the whole program. Rapids are counted at [`rapid_rate`]; tool changes are not counted.
    pub fn minutes(&self) -> f64 {
        self.cutting + self.dwelling + self.distances[0] / rapid_rate(self.units)
    }

    /// Adds a feed move: its length along X, Y and Z, and the angle by which the part turns if the length is 0. The
    /// feed of such a turn is in degrees per minute. `radius` is the radius of a lathe cut.
    fn cut(&mut self, [length, turned]: [f64; 2], feed: f64, lead: Option<f64>, radius: f64) {
        self.distances[1] += length;
        let units = self.units.in_mm();
        let (path, scale) = if length > 0.0 { (length * units, units) } else { (turned, 1.0) };
        let minutes = match lead {
            None if self.pace.is_inverse() => 1.0 / feed,
            _ => path / self.pace.per_minute(feed, lead, path, scale, radius * units),
        };
        if minutes.is_finite() { self.cutting += minutes } else { self.timeless += u64::from(path > 0.0) }
    }

    fn reach(&mut self, at: &Position) {
        let extents = self.extents.get_or_insert([(at[0], at[0]), (at[1], at[1]), (at[2], at[2])]);
        for (axis, (least, greatest)) in extents.iter_mut().enumerate() {
            (*least, *greatest) = (least.min(at[axis]), greatest.max(at[axis]));
        }
    }

    /// Extends the extents to the quadrant points that an arc passes.
    fn round(&mut self, turn: &Turn) {
        let [first, second, _] = axes_of(turn.plane);
        let radius = (self.at[first] - turn.center[first]).hypot(self.at[second] - turn.center[second]);
        let swept = sweep(&self.at, turn);
        let start = (self.at[second] - turn.center[second]).atan2(self.at[first] - turn.center[first]);
        let sign = if turn.direction == Direction::Ccw { 1.0 } else { -1.0 };
        for quadrant in 0..4 {
            let angle = f64::from(quadrant) * std::f64::consts::FRAC_PI_2;
            let ahead = (sign * (angle - start)).rem_euclid(std::f64::consts::TAU);
            if ahead < swept {
                let mut at = self.at;
                at[first] = turn.center[first] + radius * angle.cos();
                at[second] = turn.center[second] + radius * angle.sin();
                self.reach(&at);
            }
        }
    }
}

/// The rapid rate for time estimates, in units per minute: 10 m/min, or 400 inch/min.
pub fn rapid_rate(units: Units) -> f64 {
    if units == Units::Inch { 400.0 } else { 10_000.0 }
}

/// Minutes as text: `1:02:03`, or `2:03` for less than an hour.
pub fn clock(minutes: f64) -> String {
    let seconds = (minutes * 60.0).round() as u64;
    let (hours, rest) = (seconds / 3600, seconds % 3600);
    if hours > 0 {
        format!("{hours}:{:02}:{:02}", rest / 60, rest % 60)
    } else {
        format!("{}:{:02}", rest / 60, rest % 60)
    }
}

fn distance(from: &Position, to: &Position) -> f64 {
    (0..3).map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt()
}

/// The angle by which rotary axes turn in a straight move, in degrees.
fn turned(from: &Position, to: &Position) -> f64 {
    (3..6).map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt()
}

/// The angle of an arc in radians. An arc that ends where it begins is a full turn.
pub(crate) fn sweep(from: &[f64], turn: &Turn) -> f64 {
    let [first, second, _] = axes_of(turn.plane);
    let angle = |at: &[f64]| (at[second] - turn.center[second]).atan2(at[first] - turn.center[first]);
    let sign = if turn.direction == Direction::Ccw { 1.0 } else { -1.0 };
    let part = (sign * (angle(&turn.to) - angle(from))).rem_euclid(std::f64::consts::TAU);
    let closed = !(1e-9..=std::f64::consts::TAU - 1e-9).contains(&part);
    let part = if closed { std::f64::consts::TAU } else { part };
    part + f64::from(turn.turns) * std::f64::consts::TAU
}

fn arc_length(from: &Position, turn: &Turn) -> f64 {
    let [first, second, across] = axes_of(turn.plane);
    let radius = (from[first] - turn.center[first]).hypot(from[second] - turn.center[second]);
    (radius * sweep(from, turn)).hypot(turn.to[across] - from[across])
}
