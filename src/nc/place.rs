//! Where the tool is, and in which frames that counts.

use super::action::{Action, Position};
use super::frames::Frames;
use super::out::Out;

/// The place of the tool, and the frame in which it is said.
#[derive(Debug)]
pub struct Place {
    /// Position in program coordinates and the program's units.
    pub position: Position,
    /// Axes that stand at a place in machine coordinates, as bits.
    pub at_machine: u8,
    /// What program coordinates count from.
    pub frames: Frames,
    /// Where G28 and G30 go, in machine coordinates.
    pub homes: [Position; 2],
}

impl Place {
    /// A place at zero; `at_machine`: axes whose place only the machine knows.
    pub fn new(at_machine: u8) -> Place {
        Place { position: [0.0; 6], at_machine, frames: Frames::default(), homes: [[0.0; 6]; 2] }
    }

    /// A rapid in program coordinates.
    #[inline]
    pub fn rapid_to(&mut self, to: Position, out: &mut Out<'_>) {
        self.position = to;
        out.push(Action::Rapid { to, machine: self.at_machine });
    }

    /// A straight feed move.
    #[inline]
    pub fn feed_to(&mut self, to: Position, feed: f64, out: &mut Out<'_>) {
        self.position = to;
        out.push(Action::Feed { to, feed, lead: None });
    }

    /// Changes the frames; the tool stays where it is.
    pub fn reframe(&mut self, change: impl FnOnce(&mut Frames)) {
        let place = self.frames.to_machine(&self.position);
        change(&mut self.frames);
        self.position = self.frames.to_program(&place);
    }

    /// All lengths in another unit.
    pub fn scale(&mut self, factor: f64) {
        self.position[..3].iter_mut().for_each(|v| *v *= factor);
        self.frames.scale(factor);
        self.homes.iter_mut().for_each(|home| home[..3].iter_mut().for_each(|v| *v *= factor));
    }
}
