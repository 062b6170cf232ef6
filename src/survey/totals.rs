//! Sums over moves, and their extents.

use crate::toolpath::Axes;
use indexmap::IndexSet;

/// Least and greatest position of each linear axis, in the job's units; `None`: no move contains a position of this axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach(pub [Option<(f64, f64)>; 3]);

impl Reach {
    /// Extends the range of one axis to a position.
    pub fn to(&mut self, axis: usize, value: f64) {
        let (least, most) = self.0[axis].unwrap_or((value, value));
        self.0[axis] = Some((least.min(value), most.max(value)));
    }

    /// Extends the ranges to a position. Axes without a value are skipped.
    pub fn moves_to(&mut self, place: &Axes) {
        for axis in 0..3 {
            if let Some(value) = place.get(axis) {
                self.to(axis, value);
            }
        }
    }

    /// Extends the ranges so that they include those of `other`.
    pub fn join(&mut self, other: &Reach) {
        for (axis, reach) in other.0.iter().enumerate() {
            if let Some((least, most)) = reach {
                self.to(axis, *least);
                self.to(axis, *most);
            }
        }
    }
}

/// Sums over a job or a part of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Totals {
    /// Number of operations.
    pub operations: u64,
    /// Number of holes of cycles.
    pub holes: u64,
    /// Length of the cuts, in the job's units.
    pub length: f64,
    /// Time of the cuts at their feeds, in minutes. Cuts with an unknown time are not included.
    minutes: f64,
    /// Whether there is a cut with an unknown time, such as one at a constant surface speed.
    untimed: bool,
    /// The extents of the cuts.
    pub cuts: Reach,
    /// The extents of cuts and rapids.
    pub moves: Reach,
    /// The work offsets of these moves, by their keys.
    pub works: IndexSet<u64>,
}

impl Totals {
    /// The sums at the beginning of an operation.
    pub fn of_operation() -> Totals {
        Totals { operations: 1, ..Totals::default() }
    }

    /// Adds a cut of this length and time; `None`: the time is unknown.
    pub fn cut(&mut self, length: f64, minutes: Option<f64>) {
        self.length += length;
        self.minutes += minutes.unwrap_or_default();
        self.untimed |= minutes.is_none();
    }

    /// Time of the cuts at their feeds, in minutes. `None`: the time of a cut is unknown.
    pub fn minutes(&self) -> Option<f64> {
        (!self.untimed).then_some(self.minutes)
    }

    /// Adds the sums of a part `times` times. Operations are not added, because they are counted where they begin.
    pub fn add(&mut self, part: &Totals, times: f64) {
        self.holes = self.holes.saturating_add((part.holes as f64 * times) as u64);
        self.length += part.length * times;
        self.minutes += part.minutes * times;
        self.untimed |= part.untimed;
        self.cuts.join(&part.cuts);
        self.moves.join(&part.moves);
        self.works.extend(&part.works);
    }

    /// Whether there are no moves and no holes.
    pub fn is_still(&self) -> bool {
        self.moves == Reach::default() && self.holes == 0
    }

    /// Whether all positions are in one work offset. Positions in several work offsets have no common least and
    /// greatest value.
    pub fn in_one_frame(&self) -> bool {
        self.works.len() <= 1
    }
}
