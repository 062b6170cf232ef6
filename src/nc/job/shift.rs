//! Frames that a program moves between its moves, by G52 or G92: a job has one frame, so its places are counted in that of the
//! program's first move.

use super::behind::Behind;
use super::fault::{Done, unsaid, warning};
use super::reader::Reader;
use crate::nc::action::{Action, Drilling, Position, Turn};

impl Reader<'_> {
    /// The frame was moved.
    pub(super) fn frame(&mut self, behind: Behind) -> Done {
        if self.place.operation == 0 {
            (self.frame, self.lost) = (behind.shift, behind.frame);
            if !std::mem::replace(&mut self.framed, true) {
                let message = "the program sets its work offsets (G10, G52 or G92), which a job can't say";
                let help = "set them at the machine: positions are those that the program writes";
                self.warnings.push(warning(self.place.line, message, help));
            }
            return Ok(());
        }
        let by: [f64; 3] = std::array::from_fn(|axis| behind.shift[axis] - self.frame[axis]);
        // G10 moves the work offset itself; how far a shift to a place of the machine moves it is unknown
        let moved = (0..3).filter(|&axis| by[axis] != self.shift[axis]).fold(0, |axes, axis| axes | 1 << axis);
        if moved == 0 || moved & behind.unknown != 0 || behind.frame != self.lost {
            let help =
                "write the places in one frame: a job has no G10, and no G92 where only the machine knows the place";
            return unsaid(self.place.line, "the program moves its coordinate frame between its moves", help);
        }
        self.end_cycle()?;
        self.shift = by;
        Ok(())
    }

    /// An action in the frame of the first move; `None`: as it stands.
    pub(super) fn shifted(&self, action: &Action) -> Option<Action> {
        if self.shift == [0.0; 3] {
            return None;
        }
        let [.., z] = self.shift;
        match action {
            &Action::Rapid { to, machine, astray, placed } => {
                Some(Action::Rapid { to: self.place_of(&to), machine, astray, placed })
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
