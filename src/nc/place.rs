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
    /// The work offset in force, by its code or number; `None`: nothing said one, and none is usual.
    pub work: Option<f64>,
    /// Where G28 and G30 go, in machine coordinates.
    pub homes: [Position; 2],
}

impl Place {
    /// A place at zero; `at_machine`: axes whose place only the machine knows.
    pub fn new(at_machine: u8, work: Option<f64>) -> Place {
        Place { position: [0.0; 6], at_machine, frames: Frames::default(), work, homes: [[0.0; 6]; 2] }
    }

    /// Takes another work offset: how far it lies from the one before, nobody knows until places are said in it. `true`: it is another.
    pub fn work_is(&mut self, work: f64) -> bool {
        self.work.replace(work) != Some(work)
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
