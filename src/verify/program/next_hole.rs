//! The next hole of a canned cycle, if it differs from the last hole only in its position. The actions of such a hole are
//! not made again: those of the last hole are moved.

use super::Program;
use crate::nc::{Action, Item};
use crate::verify::cut::{ALL, Place, same};

impl Program<'_> {
    /// Prepares [`Program::next_hole`]. Call this function after the only cut of a hole was taken.
    pub fn expects_hole(&mut self) {
        let (made, rest) = self.items.split_at(self.next);
        let is_one_cut = match made {
            [Item { action: Action::Hole(_), .. }, before @ .., cut] => match &cut.action {
                Action::Feed { to: end, lead: None, machine: 0, home: 0, .. } => {
                    let is_over = |item: &Item| matches!(&item.action, Action::Rapid { to, machine: 0, .. } if to[..2] == end[..2]);
                    before.iter().chain(rest).all(is_over)
                }
                _ => false,
            },
            _ => false,
        };
        self.is_alike = is_one_cut
            && !rest.is_empty()
            && self.unknown == 0
            && self.simulator.state().frame_unknown() == 0
            && self.is_usual();
    }

    /// Makes the next hole, if it differs from the last hole only in its position, and if its cut ends at this
    /// position of the job. `false`: nothing was run.
    pub fn next_hole(&mut self, end: &Place, tolerance: f64) -> bool {
        if !self.is_alike {
            return false;
        }
        let Some(Action::Feed { to, .. }) = self.next.checked_sub(1).map(|cut| &self.items[cut].action) else {
            return false;
        };
        let Some(hole) = self.simulator.next_hole() else { return false };
        let [x, y, ..] = hole.at;
        let [_, _, z, a, b, c] = *to;
        let at = self.scale.place(&[x, y, z, a, b, c]);
        // without a move to the hole, other actions would follow
        if at == self.at || !same(&at, end, ALL, tolerance) {
            return false;
        }
        self.keep_line();
        self.simulator.make_hole(&hole);
        let line = self.simulator.line();
        for item in &mut self.items[self.next - 1..] {
            item.line = line;
            if let Action::Rapid { to, .. } | Action::Feed { to, .. } = &mut item.action {
                (to[0], to[1]) = (x, y);
            }
        }
        self.ends_cut(at);
        true
    }
}
