//! Where the tool is, and in which frames that counts.

use super::action::{Action, Position};
use super::frames::Frames;
use super::out::Out;

/// The position of the tool, and the frame in which it counts.
#[derive(Clone, Debug)]
pub struct Place {
    /// Position in program coordinates and the program's units; on axes in `at_machine` it counts from wherever the
    /// machine stood.
    pub position: Position,
    /// Axes that stand at a place in machine coordinates, as bits.
    pub at_machine: u8,
    /// Those of them that increments have moved since: they are at that place no longer, and their position is unknown.
    pub astray: u8,
    /// Those of them whose place in machine coordinates the program said, as bits.
    pub placed: u8,
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
        Place {
            position: [0.0; 6],
            at_machine,
            astray: 0,
            placed: 0,
            frames: Frames::default(),
            work,
            homes: [[0.0; 6]; 2],
        }
    }

    /// Takes another work offset: how far it lies from the one before, nobody knows until places are said in it. `true`: it is another.
    pub fn work_is(&mut self, work: f64) -> bool {
        self.work.replace(work) != Some(work)
    }

    /// The program gives the position of an axis.
    #[inline]
    pub fn given(&mut self, axis: usize) {
        self.at_machine &= !(1 << axis);
        self.astray &= !(1 << axis);
        self.placed &= !(1 << axis);
    }

    /// An axis moves by an increment.
    #[inline]
    pub fn moves_by(&mut self, axis: usize, by: f64) {
        if by != 0.0 {
            self.astray |= self.at_machine & 1 << axis;
            self.placed &= !(1 << axis);
        }
    }

    /// Axes go to a position that increments from a place of the machine give.
    pub fn strays(&mut self, axes: u8) {
        self.at_machine |= axes;
        self.astray |= axes;
        self.placed &= !axes;
    }

    /// Axes go to a place of the machine, which the program says.
    pub fn goes_home(&mut self, axes: u8) {
        self.at_machine |= axes;
        self.astray &= !axes;
        self.placed |= axes;
    }

    /// Axes go to a place of the machine that the program does not say: where tools are changed, or where a cycle began.
    pub fn goes_to_machine(&mut self, axes: u8) {
        self.goes_home(axes);
        self.placed &= !axes;
    }

    /// Axes stay, and from here on only the machine knows where.
    pub fn becomes_unknown(&mut self, axes: u8) {
        self.placed &= !axes;
        self.astray &= self.at_machine;
        self.at_machine |= axes;
    }

    /// A rapid in program coordinates.
    #[inline]
    pub fn rapid_to(&mut self, to: Position, out: &mut Out<'_>) {
        self.position = to;
        let machine = self.at_machine;
        out.push(Action::Rapid { to, machine, astray: self.astray & machine, placed: self.placed & machine });
    }

    /// A straight feed move; `lead`: it follows the spindle, by so much a turn.
    #[inline]
    pub fn feed_to(&mut self, to: Position, feed: f64, lead: Option<f64>, out: &mut Out<'_>) {
        self.position = to;
        out.push(Action::Feed { to, feed, lead, machine: self.at_machine, home: 0 });
    }

    /// A feed move that takes these axes to a place of the machine.
    pub fn feed_home(&mut self, to: Position, axes: u8, feed: f64, out: &mut Out<'_>) {
        self.position = to;
        out.push(Action::Feed { to, feed, lead: None, machine: self.at_machine, home: axes });
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
