//! The heights that a tool has reached: by rapid, and in its cuts.

use crate::nc::{Action, Position};

/// The heights of the moves since the last change of the tool, its length, the work offset or the units. Heights that
/// depend on the machine do not count.
#[derive(Clone, Copy, Debug, Default)]
pub struct Levels {
    /// The greatest height of the rapids in X or Y.
    pub across: Option<f64>,
    /// The greatest height at which a rapid has ended.
    top: Option<f64>,
    /// The greatest height at which a cut has ended.
    cut: Option<f64>,
}

impl Levels {
    /// Adds a move that begins at `at`, and sets `at` to its end.
    pub fn follow(&mut self, action: &Action, at: &mut Position) {
        let (to, machine) = match action {
            Action::Rapid { to, machine, .. } | Action::Feed { to, machine, .. } => (*to, *machine),
            Action::Arc(turn) => (turn.to, turn.machine),
            _ => return,
        };
        let from = std::mem::replace(at, to);
        if machine & 0b100 != 0 {
            return;
        }
        let is_across = (0..2).any(|axis| (to[axis] - from[axis]).abs() > 1e-9);
        let is_rapid = matches!(action, Action::Rapid { .. });
        // a feed move straight up is the way out of a cut
        let cuts = !is_rapid && (is_across || to[2] <= from[2]);
        for (level, counts) in
            [(&mut self.across, is_rapid && is_across), (&mut self.top, is_rapid), (&mut self.cut, cuts)]
        {
            if counts {
                *level = Some(level.map_or(to[2], |level| level.max(to[2])));
            }
        }
    }

    /// Whether a height is above all cuts.
    pub fn is_clear(&self, height: f64) -> bool {
        self.cut.is_none_or(|cut| height > cut + 1e-9)
    }

    /// A height of the rapids above `depth` and above all cuts.
    pub fn above(&self, depth: f64) -> Option<f64> {
        [self.across, self.top].into_iter().flatten().find(|height| *height > depth && self.is_clear(*height))
    }
}
