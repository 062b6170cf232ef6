//! The holes of one cycle, even if rapids are between them.

use crate::nc::action::{Drilling, Position};
use crate::toolpath::Place;

/// A cycle whose holes are being read.
pub(super) struct Pattern {
    pub first: Drilling,
    pub last: Drilling,
    /// Rapids at the return level after the last hole. These rapids may be moves to the next hole.
    pub way: Vec<(Position, Place)>,
}

/// Maximum number of rapids between two holes of a cycle.
const MOST_WAY: usize = 4;
/// Heights that differ by less than this are equal.
const SAME: f64 = 1e-9;

impl Pattern {
    /// Whether a rapid may be a move to the next hole.
    pub fn may_lead(&self, to: &Position) -> bool {
        let level = (to[2] - self.first.clear).abs() < SAME && to[3..] == self.last.at[3..];
        level && self.way.len() < MOST_WAY
    }

    /// Whether all stored rapids end at the X and Y of the last hole or of this hole.
    pub fn leads_to(&self, hole: &Drilling) -> bool {
        self.way.iter().all(|(to, _)| to[..2] == self.last.at[..2] || to[..2] == hole.at[..2])
    }
}
