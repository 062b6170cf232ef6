//! Handles frames that a program shifts between its moves, by G52 or G92. A job has only one frame, so all positions
//! are converted to the frame of the program's first move.

use super::behind::Behind;
use super::fault::{Done, unsaid, warning};
use super::reader::Reader;
use crate::nc::action::{Action, Drilling, Position, Turn};

impl Reader<'_> {
    /// Handles an action that moves the frame.
    pub(super) fn frame(&mut self, behind: Behind) -> Done {
        if self.place.operation == 0 {
            (self.frame, self.lost) = (behind.shift, behind.frame);
            if !std::mem::replace(&mut self.framed, true) {
                let message = "the program sets its work offsets (G10, G52 or G92): a job can't contain this";
                let help = "set the work offsets at the machine: the positions of the program are unchanged";
                self.warnings.push(warning(self.place.line, message, help));
            }
            return Ok(());
        }
        let by: [f64; 3] = std::array::from_fn(|axis| behind.shift[axis] - self.frame[axis]);
        // refused: G10, which changes the work offset itself, and a shift at a machine position, whose distance is unknown
        let moved = (0..3).filter(|&axis| by[axis] != self.shift[axis]).fold(0, |axes, axis| axes | 1 << axis);
        if moved == 0 || moved & behind.unknown != 0 || behind.frame != self.lost {
            let help = "write all positions in one frame: a job has no G10, and no G92 at an unknown machine position";
            return unsaid(self.place.line, "the program moves its coordinate frame between its moves", help);
        }
        self.end_cycle()?;
        self.shift = by;
        Ok(())
    }

    /// Converts an action to the frame of the first move; `None`: the action does not change.
    pub(super) fn shifted(&self, action: &Action) -> Option<Action> {
        if self.shift == [0.0; 3] {
            return None;
        }
        let [.., z] = self.shift;
        match action {
            &Action::Rapid { to, machine, astray, placed, kept } => {
                Some(Action::Rapid { to: self.place_of(&to), machine, astray, placed, kept })
            }
            &Action::Feed { to, feed, lead, machine, home } => {
                Some(Action::Feed { to: self.place_of(&to), feed, lead, machine, home })
            }
            Action::Arc(turn) => {
                let center = std::array::from_fn(|axis| turn.center[axis] + self.shift[axis]);
                Some(Action::Arc(Turn { to: self.place_of(&turn.to), center, ..*turn }))
            }
            Action::Hole(hole) => {
                let Drilling { at, r, bottom, clear, level, .. } = **hole;
                let (r, bottom, clear, level) = (r + z, bottom + z, clear + z, level + z);
                Some(Action::Hole(Box::new(Drilling { at: self.place_of(&at), r, bottom, clear, level, ..**hole })))
            }
            _ => None,
        }
    }

    fn place_of(&self, to: &Position) -> Position {
        let mut to = *to;
        for (value, shift) in to.iter_mut().zip(self.shift) {
            *value += shift;
        }
        to
    }
}
