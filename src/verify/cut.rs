//! Cuts and the ways to them: what job and program are compared by.

use std::ops::{Deref, DerefMut};
use std::rc::Rc;

use super::tables::{ANGLE, MOMENT, ORIENTED, ROUNDED};
use crate::nc::{Cooling, Position, Rotation, Threading, Turn, axes_of, sweep};
use crate::toolpath::{FeedMode, Plane, Side};

/// A place: X Y Z in the job's units, A B C in degrees, and U V, the upper guide of a wire, in the job's units.
pub(super) type Place = [f64; 8];

/// A place as the program counts it.
pub(super) fn position(place: &Place) -> Position {
    let [x, y, z, a, b, c, ..] = *place;
    [x, y, z, a, b, c]
}

/// U or V of a wire that nobody guides: it goes straight down.
pub(super) const UNSAID: f64 = 1e9;

/// The place of a mill or a lathe.
pub(super) fn place(position: &Position) -> Place {
    let [x, y, z, a, b, c] = *position;
    [x, y, z, a, b, c, UNSAID, UNSAID]
}

/// A rapid on the way to a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rapid {
    pub to: Place,
    /// Axes whose place only the machine knows.
    pub unknown: u8,
    /// Rotation or angle of the spindle, where it matters.
    pub spin: Option<Spin>,
}

/// What the spindle does while the tool moves at rapid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spin {
    /// The spindle turns, or stands anyhow.
    Turns(Rotation),
    /// The spindle stands at this angle, in degrees.
    At(f64),
    /// The spindle stands at an angle that a parameter of the control says.
    Oriented,
}

impl Spin {
    /// Is a spindle as the job wants it? Whichever way a standing spindle was stopped, it stands.
    pub fn serves(self, wanted: Spin) -> bool {
        match (wanted, self) {
            (Spin::At(a), Spin::At(b)) => ((a - b) / 360.0).fract().abs() * 360.0 < ORIENTED,
            (Spin::At(_) | Spin::Oriented, Spin::Oriented) | (Spin::Oriented, Spin::At(_)) => true,
            (Spin::Turns(a), Spin::Turns(b)) => a == b,
            (Spin::Turns(a), _) => a == Rotation::Stop,
            (_, Spin::Turns(_)) => false,
        }
    }
}

/// What is done where the way ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum What {
    /// A straight feed move.
    Line { to: Place },
    /// An arc.
    Arc(Turn),
}

impl What {
    /// Where the move ends.
    pub fn end(&self) -> Place {
        match self {
            What::Line { to } => *to,
            What::Arc(turn) => place(&turn.to),
        }
    }
}

/// What is in force at a cut; `None` is not known, or does not matter.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(super) struct State {
    pub tool: Option<f64>,
    pub work: Option<f64>,
    pub rotation: Option<Rotation>,
    pub speed: Option<f64>,
    /// Coolant.
    pub coolant: Option<Cooling>,
    /// Cutter compensation: `None` inside is off.
    pub side: Option<Option<Side>>,
    /// Registers of tool length, and of the diameter while compensation is on.
    pub length: Option<f64>,
    pub diameter: Option<f64>,
    /// The speed is a surface speed.
    pub css: bool,
    /// Highest revolutions, which a surface speed comes to near the axis.
    pub limit: Option<f64>,
    /// The plane that compensation is in.
    pub plane: Plane,
    /// The control keeps feed and spindle in step.
    pub rigid: Option<bool>,
    /// What a thread says besides its moves.
    pub thread: Threading,
    /// How the spindle turned where a control's floating tap begins; of the job: how it must.
    pub into_tap: Option<Rotation>,
}

impl State {
    /// A control's tap begins, which goes in with this rotation: a rigid one turns the spindle itself, a floating one goes in
    /// as it turned before.
    pub fn taps(&mut self, inwards: Rotation) {
        let floats = self.rigid == Some(false);
        self.into_tap = self.rotation.filter(|_| floats);
        if !floats {
            self.rotation = Some(inwards);
        }
    }

    /// The canned cycle is over.
    pub fn cycle_ends(&mut self) {
        (self.into_tap, self.rigid) = (None, self.rigid.map(|_| false));
    }
}

/// A state that many cuts have: they share it until it changes, and two that share it are alike at a glance.
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
    /// The state as its own, to be changed: who shares it keeps what it was.
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
    /// Axes of `from` that only the machine knows.
    pub unknown: u8,
    /// Axes that the cut takes to a place of the machine (G53 under G1).
    pub home: u8,
    /// Axes of its end that only the machine knows.
    pub open: u8,
    pub what: What,
    pub feed: Option<f64>,
    pub mode: FeedMode,
    /// It follows the spindle, by so much a turn.
    pub lead: Option<f64>,
    pub state: Shared,
    /// What sequences print for that the job has had: since its last spindle word, and whose feed this cut may have.
    pub by: [u8; 2],
    /// A canned cycle of the control makes it.
    pub by_cycle: bool,
    /// The program's line, or 0.
    pub line: u64,
}

impl Cut {
    /// Where the cut ends.
    pub fn end(&self) -> Place {
        self.what.end()
    }

    /// Is the cut so short that the digits of a program may swallow it? No circle is: it comes back to where it began.
    pub fn is_short(&self, tolerance: f64) -> bool {
        let end = self.end();
        let near = same(&self.from, &end, ALL, tolerance) && turn_as_far([&self.from, &self.from], [&self.from, &end]);
        near && match &self.what {
            What::Line { .. } => true,
            What::Arc(turn) => is_straight(self, turn, tolerance),
        }
    }
}

/// Is an arc so short in its plane that the digits of a program may swallow that?
pub(super) fn is_straight(cut: &Cut, turn: &Turn, tolerance: f64) -> bool {
    let [first, second, _] = axes_of(turn.plane);
    let radius = (cut.from[first] - turn.center[first]).hypot(cut.from[second] - turn.center[second]);
    turn.turns == 0 && radius * sweep(&cut.from, turn) <= 2.0 * tolerance
}

/// The axes as bits.
pub(super) const ALL: u8 = 0xff;
/// The names of the axes.
pub(super) const NAMES: [u8; 8] = *b"XYZABCUV";
/// The axis across a lathe's part, as an index: the radius.
pub(super) const RADIUS: usize = 0;
/// The axis along which holes go, as an index.
pub(super) const DEPTH: usize = 2;
/// All but the depth.
pub(super) const ACROSS: u8 = ALL & !(1 << DEPTH);

/// Are two places one, on these axes? An angle and the same after a whole turn are.
#[inline]
pub(super) fn same(a: &Place, b: &Place, axes: u8, tolerance: f64) -> bool {
    // most are near on every axis, which needs no branches
    let all_near = a.iter().zip(b).fold(true, |near, (a, b)| near & ((a - b).abs() <= tolerance));
    all_near || same_on(a, b, axes, tolerance)
}

fn same_on(a: &Place, b: &Place, axes: u8, tolerance: f64) -> bool {
    (0..8).filter(|axis| axes & 1 << axis != 0).all(|axis| {
        let difference = a[axis] - b[axis];
        difference.abs() <= tolerance
            || ((3..6).contains(&axis)
                && (difference - 360.0 * (difference / 360.0).round()).abs() <= tolerance.max(ANGLE))
    })
}

/// Do two cuts turn their angles as far?
pub(super) fn turn_as_far(a: [&Place; 2], b: [&Place; 2]) -> bool {
    (3..6).all(|axis| ((a[1][axis] - a[0][axis]) - (b[1][axis] - b[0][axis])).abs() <= 2.0 * ANGLE)
}

/// Is b on the straight way from a to c?
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
        && (0..8).all(|axis| (a[axis] + part * (c[axis] - a[axis]) - b[axis]).abs() <= tolerance)
}

/// Do two cuts lead the same way, rather than back or straight across? Of an arc its ends say nothing.
pub(super) fn lead_alike(a: &Cut, b: &Cut) -> bool {
    let [own, other] = [a, b].map(|cut| (cut.from, cut.end()));
    let along: f64 = (0..8).map(|axis| (own.1[axis] - own.0[axis]) * (other.1[axis] - other.0[axis])).sum();
    along > 0.0 || matches!(b.what, What::Arc(_))
}

/// How far apart two places are along their farthest axis.
pub(super) fn distance(a: &Place, b: &Place) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// How far apart two places are, straight.
pub(super) fn apart(a: &Place, b: &Place) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// `X1 Y2.5 Z-0.1`, with angles where there are any.
pub(super) fn shown(place: &Place, axes: u8) -> String {
    // a guided wire has no height
    let axes = if place[6] == UNSAID && place[7] == UNSAID { axes } else { 0b1100_0011 };
    let words = (0..8).filter(|&axis| axes & 1 << axis != 0);
    let list: Vec<String> = words.map(|axis| format!("{}{}", char::from(NAMES[axis]), number(place[axis]))).collect();
    list.join(" ")
}

/// Where a hole is: X and Y, and angles that are not zero.
pub(super) fn over(place: &Place) -> String {
    let turned = (3..6).filter(|&axis| place[axis] != 0.0).map(|axis| 1 << axis).sum::<u8>();
    shown(place, 0b11 | turned)
}

/// A number as a person reads it.
pub(super) fn number(value: f64) -> f64 {
    let rounded = (value * 1e5).round() / 1e5;
    if rounded == 0.0 { 0.0 } else { rounded }
}

/// Two dwells in seconds are one: revolutions as a time are not whole milliseconds.
pub(super) fn same_dwell(wanted: f64, is: f64) -> bool {
    (wanted - is).abs() <= (ROUNDED * wanted).max(MOMENT)
}
