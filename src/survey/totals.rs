//! What adds up over cuts, and how far they reach.

use crate::toolpath::Axes;
use indexmap::IndexSet;

/// Least and greatest position of each linear axis, in the job's units; `None`: no move says it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach(pub [Option<(f64, f64)>; 3]);

impl Reach {
    /// Reaches to a position of one axis.
    pub fn to(&mut self, axis: usize, value: f64) {
        let (least, most) = self.0[axis].unwrap_or((value, value));
        self.0[axis] = Some((least.min(value), most.max(value)));
    }

    /// Reaches to a place, as far as it is given.
    pub fn moves_to(&mut self, place: &Axes) {
        for axis in 0..3 {
            if let Some(value) = place.get(axis) {
                self.to(axis, value);
            }
        }
    }

    /// Reaches as far as the other does.
    pub fn join(&mut self, other: &Reach) {
        for (axis, reach) in other.0.iter().enumerate() {
            if let Some((least, most)) = reach {
                self.to(axis, *least);
                self.to(axis, *most);
            }
        }
    }
}

/// Sums of a job or of a part of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Totals {
    /// Operations.
    pub operations: u64,
    /// Holes of cycles.
    pub holes: u64,
    /// Length of the cuts, in the job's units.
    pub length: f64,
    /// Time of the cuts at their feeds, in minutes, as far as it is known.
    minutes: f64,
    /// There is a cut whose time is unknown, as at a constant surface speed.
    untimed: bool,
    /// How far cuts reach.
    pub cuts: Reach,
    /// How far cuts and rapids reach.
    pub moves: Reach,
    /// The work offsets in which that counts, by their keys.
    pub works: IndexSet<u64>,
}

impl Totals {
    /// Those of an operation that begins.
    pub fn of_operation() -> Totals {
        Totals { operations: 1, ..Totals::default() }
    }

    /// A cut of this length takes so many minutes; `None`: nobody knows.
    pub fn cut(&mut self, length: f64, minutes: Option<f64>) {
        self.length += length;
        self.minutes += minutes.unwrap_or_default();
        self.untimed |= minutes.is_none();
    }

    /// Time of the cuts at their feeds, in minutes, where that of each is known.
    pub fn minutes(&self) -> Option<f64> {
        (!self.untimed).then_some(self.minutes)
    }

    /// Adds those of a part, `times` over; operations are counted where they begin.
    pub fn add(&mut self, part: &Totals, times: f64) {
        self.holes = self.holes.saturating_add((part.holes as f64 * times) as u64);
        self.length += part.length * times;
        self.minutes += part.minutes * times;
        self.untimed |= part.untimed;
        self.cuts.join(&part.cuts);
        self.moves.join(&part.moves);
        self.works.extend(&part.works);
    }

    /// Is there no move in it?
    pub fn is_still(&self) -> bool {
        self.moves == Reach::default() && self.holes == 0
    }

    /// Positions of several work offsets are not of one frame: no least and greatest of them means anything.
    pub fn in_one_frame(&self) -> bool {
        self.works.len() <= 1
    }
}
