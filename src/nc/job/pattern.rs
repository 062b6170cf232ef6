//! Holes of one cycle, whichever rapids connect them.

use crate::nc::action::{Drilling, Position};
use crate::toolpath::Place;

/// A cycle in progress.
pub(super) struct Pattern {
    pub first: Drilling,
    pub last: Drilling,
    /// Rapids after the last hole at its return level. They may be moves to the next hole.
    pub way: Vec<(Position, Place)>,
}

/// The largest number of rapids from one hole to the next.
const MOST_WAY: usize = 4;
/// Heights that differ by less are equal.
const SAME: f64 = 1e-9;

impl Pattern {
    /// Whether a rapid may be a move to the next hole.
    pub fn may_lead(&self, to: &Position) -> bool {
        let level = (to[2] - self.first.clear).abs() < SAME && to[3..] == self.last.at[3..];
        level && self.way.len() < MOST_WAY
    }

    /// Whether the rapids after the last hole move to this hole and to no other position.
    pub fn leads_to(&self, hole: &Drilling) -> bool {
        self.way.iter().all(|(to, _)| to[..2] == self.last.at[..2] || to[..2] == hole.at[..2])
    }
}
