//! Holes of one cycle, whatever leads from one to the next.

use crate::nc::action::{Drilling, Position};
use crate::toolpath::Place;

/// A cycle that goes on.
pub(super) struct Pattern {
    pub first: Drilling,
    pub last: Drilling,
    /// Rapids after the last hole, as high as it was left: they may only lead to the next.
    pub way: Vec<(Position, Place)>,
}

/// Most rapids from one hole to the next.
const MOST_WAY: usize = 4;
/// Heights that differ by less are one.
const SAME: f64 = 1e-9;

impl Pattern {
    /// May a rapid lead to the next hole?
    pub fn may_lead(&self, to: &Position) -> bool {
        let level = (to[2] - self.first.clear).abs() < SAME && to[3..] == self.last.at[3..];
        level && self.way.len() < MOST_WAY
    }

    /// Do the rapids after the last hole lead to this one, and nowhere else?
    pub fn leads_to(&self, hole: &Drilling) -> bool {
        self.way.iter().all(|(to, _)| to[..2] == self.last.at[..2] || to[..2] == hole.at[..2])
    }
}
