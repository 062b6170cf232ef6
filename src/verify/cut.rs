//! The data types for the cuts of job and program, and for the rapids to these cuts, that the comparison uses.

use std::ops::{Deref, DerefMut};
use std::rc::Rc;

use super::tables::{ANGLE, MOMENT, ORIENTED, ROUNDED};
use crate::control::Motions;
use crate::lang::Coolant;
use crate::nc::{Cycle, Position, Rotation, Threading, Turn, axes_of, sweep};
use crate::toolpath::{FeedMode, Plane, Side};

/// A position: X Y Z in the job's units, A B C in degrees, and U V of the upper wire guide in the job's units.
pub(super) type Place = [f64; 8];

/// The X Y Z A B C of a position.
pub(super) fn position(place: &Place) -> Position {
    let [x, y, z, a, b, c, ..] = *place;
    [x, y, z, a, b, c]
}

/// Value of U or V if the program does not move the upper wire guide separately. In this case the wire is vertical.
pub(super) const UNSAID: f64 = 1e9;

/// Converts a position of a mill or lathe to a `Place`. U and V of the `Place` have no value.
pub(super) fn place(position: &Position) -> Place {
    let [x, y, z, a, b, c] = *position;
    [x, y, z, a, b, c, UNSAID, UNSAID]
}

/// A rapid on the path to a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rapid {
    pub to: Place,
    /// Axes whose position is known only at the machine, as bits.
    pub unknown: u8,
    /// Of the axes in `unknown`, the axes that have not moved since the work offset changed, as bits.
    pub kept: u8,
    /// The state of the spindle, required by the job or set by the program, if the state matters.
    pub spin: Option<Spin>,
}

impl Rapid {
    /// Whether the rapid ends at a machine position along one of these axes.
    pub fn is_at_machine(&self, axes: u8) -> bool {
        self.unknown & !self.kept & axes != 0
    }

    /// The end of the rapid in a message: the known ones of its coordinates.
    pub fn text(&self) -> String {
        match 0b111 & !self.unknown {
            0 => "a machine position".to_owned(),
            known => shown(&self.to, known),
        }
    }

    /// The height. A height that is known only at the machine is infinite, so that no known height counts as above it.
    pub fn height(&self) -> f64 {
        if self.unknown & 1 << DEPTH != 0 { f64::INFINITY } else { self.to[DEPTH] }
    }
}

/// State of the spindle during a rapid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spin {
    /// The spindle turns, or is stopped at any angle.
    Turns(Rotation),
    /// The spindle is stopped at this angle, in degrees.
    At(f64),
    /// The spindle is stopped at an angle that a parameter of the control defines.
    Oriented,
}

impl Spin {
    /// Whether the spindle is in the state that the job requires. If the job only requires a stopped spindle, the angle
    /// at which it stops does not matter.
    pub fn serves(self, wanted: Spin) -> bool {
        match (wanted, self) {
            (Spin::At(a), Spin::At(b)) => without_turns(a - b).abs() < ORIENTED,
            (Spin::At(_) | Spin::Oriented, Spin::Oriented) | (Spin::Oriented, Spin::At(_)) => true,
            (Spin::Turns(a), Spin::Turns(b)) => a == b,
            (Spin::Turns(a), _) => a == Rotation::Stop,
            (_, Spin::Turns(_)) => false,
        }
    }
}

/// A cutting motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum What {
    /// A straight feed move.
    Line { to: Place },
    /// An arc.
    Arc(Turn),
}

impl What {
    /// The end of the motion.
    pub fn end(&self) -> Place {
        match self {
            What::Line { to } => *to,
            What::Arc(turn) => place(&turn.to),
        }
    }
}

/// The modal state at a cut. `None`: the value is unknown or has no effect.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(super) struct State {
    pub tool: Option<f64>,
    pub work: Option<f64>,
    pub rotation: Option<Rotation>,
    pub speed: Option<f64>,
    /// Coolant.
    pub coolant: Option<Coolant>,
    /// Cutter compensation. `Some(None)`: off.
    pub side: Option<Option<Side>>,
    /// Register of the tool length. The field after `length` is the register of the diameter while cutter compensation
    /// is on.
    pub length: Option<f64>,
    pub diameter: Option<f64>,
    /// The diameter and the orientation of the compensated tool, if the program gives them.
    pub cutter: Option<[f64; 2]>,
    /// Whether the speed is a surface speed.
    pub css: bool,
    /// Highest speed of the spindle. Near the axis of a lathe, a surface speed is limited to this value.
    pub limit: Option<f64>,
    /// The plane of the cutter compensation.
    pub plane: Plane,
    /// Whether the control synchronises feed and spindle (rigid tapping).
    pub rigid: Option<bool>,
    /// Data of a thread that its moves do not contain.
    pub thread: Threading,
    /// Rotation of the spindle when the control's cycle for a floating tap begins. For a cut of the job: the required
    /// rotation.
    pub into_tap: Option<Rotation>,
    /// The angle to which the control's tapping cycle turns the spindle before the thread.
    pub tap_start: Option<f64>,
}

impl State {
    /// Begins a tapping cycle of the control. A rigid tap starts the spindle itself. A floating tap uses the rotation
    /// that is already on. If the code of the cycle does not define whether the tap is rigid, M29 before it decides.
    pub fn taps(&mut self, cycle: Cycle) {
        let inwards = if cycle.motions == Motions::Tap { Rotation::Cw } else { Rotation::Ccw };
        (self.rigid, self.tap_start) = (cycle.rigid.or(self.rigid), cycle.start);
        let floats = self.rigid == Some(false);
        self.into_tap = self.rotation.filter(|_| floats);
        if !floats {
            self.rotation = Some(inwards);
        }
    }

    /// Ends a canned cycle. `ahead`: whether a separate code (M29) makes the next tap rigid.
    pub fn cycle_ends(&mut self, ahead: bool) {
        (self.into_tap, self.tap_start, self.rigid) = (None, None, ahead.then_some(false));
    }
}

/// A modal state that consecutive cuts share until the state changes. Two shared states are compared by their pointers
/// first.
#[derive(Clone, Debug, Default)]
pub(super) struct Shared(Rc<State>);

impl From<State> for Shared {
    fn from(state: State) -> Shared {
        Shared(Rc::new(state))
    }
}

impl Deref for Shared {
    type Target = State;

    #[inline]
    fn deref(&self) -> &State {
        &self.0
    }
}

impl DerefMut for Shared {
    /// The state, as a value that may be changed. Other cuts with the shared state keep the old state.
    fn deref_mut(&mut self) -> &mut State {
        Rc::make_mut(&mut self.0)
    }
}

impl PartialEq for Shared {
    #[inline]
    fn eq(&self, other: &Shared) -> bool {
        Rc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

/// A cut.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    pub from: Place,
    /// Axes of `from` whose position is known only at the machine, as bits.
    pub unknown: u8,
    /// Axes that the cut moves to a machine position (G53 under G1).
    pub home: u8,
    /// Axes that end at an unknown machine position.
    pub open: u8,
    pub what: What,
    pub feed: Option<f64>,
    pub mode: FeedMode,
    /// Feed per turn, if the control synchronises the cut with the spindle.
    pub lead: Option<f64>,
    pub state: Shared,
    /// Kinds of events, as the bits of `form_values::by`: the events of the job since its last spindle event, and the
    /// events that may have set the feed of this cut.
    pub by: [u8; 2],
    /// Whether a canned cycle of the control makes the cut.
    pub by_cycle: bool,
    /// The program's line; 0 for a cut of the job.
    pub line: u64,
}

impl Cut {
    /// The end of the cut.
    pub fn end(&self) -> Place {
        self.what.end()
    }

    /// Whether the cut is so short that its start and end may have the same digits in a program. A full circle is never
    /// short, although it ends where it begins.
    pub fn is_short(&self, tolerance: f64) -> bool {
        let end = self.end();
        let near = same(&self.from, &end, ALL, tolerance) && turn_as_far([&self.from, &self.from], [&self.from, &end]);
        near && match &self.what {
            What::Line { .. } => true,
            What::Arc(turn) => is_straight(self, turn, tolerance),
        }
    }
}

/// Whether an arc is so short in its plane that the digits of a program may show it as a straight line.
pub(super) fn is_straight(cut: &Cut, turn: &Turn, tolerance: f64) -> bool {
    let [first, second, _] = axes_of(turn.plane);
    let radius = (cut.from[first] - turn.center[first]).hypot(cut.from[second] - turn.center[second]);
    turn.turns == 0 && radius * sweep(&cut.from, turn) <= 2.0 * tolerance
}

/// All axes, as bits.
pub(super) const ALL: u8 = 0xff;
/// The names of the axes.
pub(super) const NAMES: [u8; 8] = *b"XYZABCUV";
/// Index of the axis across a lathe's part. The position along this axis is the radius.
pub(super) const RADIUS: usize = 0;
/// Index of the axis along which holes are drilled.
pub(super) const DEPTH: usize = 2;
/// All axes except the depth.
pub(super) const ACROSS: u8 = ALL & !(1 << DEPTH);

/// Whether two positions are equal on these axes. Angles that differ by full turns are equal.
#[inline]
pub(super) fn same(a: &Place, b: &Place, axes: u8, tolerance: f64) -> bool {
    // fast path without branches: most positions are equal on all axes
    let all_near = a.iter().zip(b).fold(true, |near, (a, b)| near & ((a - b).abs() <= tolerance));
    all_near || same_on(a, b, axes, tolerance)
}

fn same_on(a: &Place, b: &Place, axes: u8, tolerance: f64) -> bool {
    (0..8).filter(|axis| axes & 1 << axis != 0).all(|axis| {
        let difference = a[axis] - b[axis];
        difference.abs() <= tolerance
            || ((3..6).contains(&axis) && without_turns(difference).abs() <= tolerance.max(ANGLE))
    })
}

/// A difference of angles in degrees without its full turns: from -180 to 180.
pub(super) fn without_turns(difference: f64) -> f64 {
    difference - 360.0 * (difference / 360.0).round()
}

/// Whether the rotary axes turn by the same number of turns and in the same direction in two moves. Both moves have the
/// same start and the same end, except for full turns.
pub(super) fn turn_as_far(a: [&Place; 2], b: [&Place; 2]) -> bool {
    turned_otherwise(a, b) == 0
}

/// As bits, the rotary axes that turn in another direction in two moves, or by more turns. Both moves have the same
/// start and the same end, except for full turns.
pub(super) fn turned_otherwise(a: [&Place; 2], b: [&Place; 2]) -> u8 {
    let way = |ends: [&Place; 2], axis: usize| ends[1][axis] - ends[0][axis];
    (3..6).filter(|&axis| (way(a, axis) - way(b, axis)).abs() > 180.0).map(|axis| 1 << axis).sum()
}

/// Whether two cuts have the same start and the same end, and turn the part as far.
pub(super) fn same_ends(a: &Cut, b: &Cut, tolerance: f64) -> bool {
    let (own, other) = (a.end(), b.end());
    same(&a.from, &b.from, ALL, tolerance)
        && same(&own, &other, ALL, tolerance)
        && turn_as_far([&a.from, &own], [&b.from, &other])
}

/// The full turns, in degrees, that must be added to the angles of `from` so that they are near the angles of `like`.
pub(super) fn turns_between(from: &Place, like: &Place) -> Place {
    std::array::from_fn(|axis| match axis {
        3..6 => 360.0 * ((like[axis] - from[axis]) / 360.0).round(),
        _ => 0.0,
    })
}

/// The position with these turns added.
pub(super) fn with_turns(place: &Place, turns: &Place) -> Place {
    std::array::from_fn(|axis| place[axis] + turns[axis])
}

/// Whether the position `b` is on the straight line from `a` to `c`, within the tolerance, and its angles are in
/// proportion.
pub(super) fn lies_between(a: &Place, b: &Place, c: &Place, tolerance: f64) -> bool {
    let (mut along, mut length) = (0.0, 0.0);
    for axis in 0..8 {
        along += (b[axis] - a[axis]) * (c[axis] - a[axis]);
        length += (c[axis] - a[axis]).powi(2);
    }
    if length == 0.0 {
        return false;
    }
    let part = along / length;
    (0.0..=1.0).contains(&part)
        && (0..8).all(|axis| {
            let near = if (3..6).contains(&axis) { tolerance.max(ANGLE) } else { tolerance };
            (a[axis] + part * (c[axis] - a[axis]) - b[axis]).abs() <= near
        })
}

/// Whether two cuts have roughly the same direction: the angle between them is less than 90 degrees. If `b` is an arc,
/// the result is `true`.
pub(super) fn lead_alike(a: &Cut, b: &Cut) -> bool {
    let [own, other] = [a, b].map(|cut| (cut.from, cut.end()));
    let along: f64 = (0..8).map(|axis| (own.1[axis] - own.0[axis]) * (other.1[axis] - other.0[axis])).sum();
    along > 0.0 || matches!(b.what, What::Arc(_))
}

/// Distance of two positions along the axis on which the positions differ most.
pub(super) fn distance(a: &Place, b: &Place) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Straight-line distance of two positions.
pub(super) fn apart(a: &Place, b: &Place) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// The position as text, such as `X1 Y2.5 Z-0.1`, with the angles that are in `axes`.
pub(super) fn shown(place: &Place, axes: u8) -> String {
    // for a wire with a tilted guide, show X Y U V
    let axes = if place[6] == UNSAID && place[7] == UNSAID { axes } else { 0b1100_0011 };
    let words = (0..8).filter(|&axis| axes & 1 << axis != 0 && place[axis] != UNSAID);
    let list: Vec<String> = words.map(|axis| format!("{}{}", char::from(NAMES[axis]), number(place[axis]))).collect();
    list.join(" ")
}

/// The position of a hole as text: X and Y, and angles that are not zero.
pub(super) fn over(place: &Place) -> String {
    let turned = (3..6).filter(|&axis| place[axis] != 0.0).map(|axis| 1 << axis).sum::<u8>();
    shown(place, 0b11 | turned)
}

/// Whether a length register of the job is active in the program. Register 0 is no length.
pub(super) fn is_length(job: Option<f64>, program: Option<f64>) -> bool {
    job == program || job == Some(0.0) && program.is_none()
}

/// A number rounded for messages.
pub(super) fn number(value: f64) -> f64 {
    let rounded = (value * 1e5).round() / 1e5;
    if rounded == 0.0 { 0.0 } else { rounded }
}

/// Whether two dwells in seconds are equal. A tolerance is needed, because dwells in revolutions are not whole milliseconds.
pub(super) fn same_dwell(wanted: f64, is: f64) -> bool {
    (wanted - is).abs() <= (ROUNDED * wanted).max(MOMENT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_of_the_spindle_are_equal_on_both_sides_of_a_full_turn() {
        let is = |a: f64, b: f64| Spin::At(a).serves(Spin::At(b));
        assert!(is(359.999, 0.001) && is(0.001, 359.999) && is(-90.0, 270.0) && is(720.0, 0.0));
        assert!(!is(359.0, 0.0) && !is(180.0, 0.0) && !is(90.0, 270.0));
    }
}
