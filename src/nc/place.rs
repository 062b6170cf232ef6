//! The position of the tool, and the frames that position refers to.

use super::action::{Action, Position};
use super::frames::Frames;
use super::out::Out;

/// X, Y and Z, as bits.
const LINEAR: u8 = 0b111;

/// The position of the tool and its coordinate frames.
#[derive(Clone, Debug)]
pub struct Place {
    /// Position in program coordinates and the program's units. For an axis in `at_machine`, the position is measured
    /// from an unknown position of the machine.
    pub position: Position,
    /// Axes whose position is in machine coordinates, as bits.
    pub at_machine: u8,
    /// As bits, the `at_machine` axes that later moved by increments. The machine position of these axes is unknown,
    /// too.
    pub astray: u8,
    /// As bits, the `at_machine` axes whose machine position the program contains.
    pub placed: u8,
    /// As bits, the `at_machine` axes that have not moved since the work offset changed. Their position is unknown only
    /// because the distance between the offsets is unknown.
    pub kept: u8,
    /// As bits, the rotary axes that the program has turned away from 0.
    pub turned: u8,
    /// The coordinate frames of the program.
    pub frames: Frames,
    /// The active work offset, by its code or number; `None`: the program has selected none, and the control has no default.
    pub work: Option<f64>,
    /// The target positions of G28 and G30, in machine coordinates.
    pub homes: [Position; 2],
}

impl Place {
    /// A position at zero. `at_machine`: as bits, the axes whose position is known only at the machine.
    pub fn new(at_machine: u8, work: Option<f64>) -> Place {
        Place {
            position: [0.0; 6],
            at_machine,
            astray: 0,
            placed: 0,
            kept: 0,
            turned: 0,
            frames: Frames::default(),
            work,
            homes: [[0.0; 6]; 2],
        }
    }

    /// Selects a work offset. Returns whether the new offset differs from the previous offset. The distance between two
    /// different offsets is unknown.
    pub fn work_is(&mut self, work: f64) -> bool {
        self.work.replace(work) != Some(work)
    }

    /// Records that the program contains the position of an axis. The position is known from now on.
    #[inline]
    pub fn given(&mut self, axis: usize) {
        self.are_given(1 << axis);
    }

    /// Records that the program contains the positions of these axes. The positions are known from now on.
    #[inline]
    pub fn are_given(&mut self, axes: u8) {
        self.at_machine &= !axes;
        self.astray &= !axes;
        self.placed &= !axes;
        self.kept &= !axes;
    }

    /// Moves an axis by an increment.
    #[inline]
    pub fn moves_by(&mut self, axis: usize, by: f64) {
        if by != 0.0 {
            self.astray |= self.at_machine & 1 << axis;
            self.placed &= !(1 << axis);
            self.kept &= !(1 << axis);
        }
    }

    /// Moves axes by increments from an unknown machine position.
    pub fn strays(&mut self, axes: u8) {
        self.at_machine |= axes;
        self.astray |= axes;
        self.placed &= !axes;
        self.kept &= !axes;
    }

    /// Moves axes to a machine position that the program contains.
    pub fn goes_home(&mut self, axes: u8) {
        self.at_machine |= axes;
        self.astray &= !axes;
        self.placed |= axes;
        self.kept &= !axes;
    }

    /// Moves axes to a machine position that the program does not contain, such as the position of a tool change or of
    /// a cycle's start.
    pub fn goes_to_machine(&mut self, axes: u8) {
        self.goes_home(axes);
        self.placed &= !axes;
    }

    /// Ends a move at a position in program coordinates.
    #[inline]
    pub fn reaches(&mut self, to: Position) {
        self.position = to;
        self.turned |= (3..6).map(|axis| u8::from(to[axis] != 0.0) << axis).sum::<u8>();
    }

    /// Makes the positions of all axes unknown. A rotary axis that the program has never turned away from 0 stays: it may
    /// not exist, and all work offsets are measured at this angle.
    pub fn loses_all(&mut self) {
        self.becomes_unknown(LINEAR | self.turned);
    }

    /// Changes to a frame at an unknown distance. The tool stays where it is, but its position in the new frame is
    /// unknown.
    pub fn loses_frame(&mut self) {
        let known = (LINEAR | self.turned) & !self.at_machine;
        let kept = self.kept & self.at_machine;
        self.loses_all();
        self.kept = kept | known;
    }

    /// Makes the position of axes unknown. From now on, the position is known only at the machine.
    pub fn becomes_unknown(&mut self, axes: u8) {
        self.placed &= !axes;
        self.kept &= !axes;
        self.astray &= self.at_machine;
        self.at_machine |= axes;
    }

    /// Makes a rapid to a position in program coordinates.
    #[inline]
    pub fn rapid_to(&mut self, to: Position, out: &mut Out<'_>) {
        self.reaches(to);
        let machine = self.at_machine;
        let [astray, placed, kept] = [self.astray, self.placed, self.kept].map(|axes| axes & machine);
        out.push(Action::Rapid { to, machine, astray, placed, kept });
    }

    /// Makes a straight feed move. `lead`: feed per revolution, if the move follows the spindle.
    #[inline]
    pub fn feed_to(&mut self, to: Position, feed: f64, lead: Option<f64>, out: &mut Out<'_>) {
        self.reaches(to);
        out.push(Action::Feed { to, feed, lead, machine: self.at_machine, home: 0 });
    }

    /// Makes a feed move that takes these axes to a machine position.
    pub fn feed_home(&mut self, to: Position, axes: u8, feed: f64, out: &mut Out<'_>) {
        self.reaches(to);
        out.push(Action::Feed { to, feed, lead: None, machine: self.at_machine, home: axes });
    }

    /// Changes the frames. The tool does not move, so its position in program coordinates changes.
    pub fn reframe(&mut self, change: impl FnOnce(&mut Frames)) {
        let place = self.frames.to_machine(&self.position);
        change(&mut self.frames);
        self.position = self.frames.to_program(&place);
    }

    /// Converts all lengths to another unit.
    pub fn scale(&mut self, factor: f64) {
        self.position[..3].iter_mut().for_each(|v| *v *= factor);
        self.frames.scale(factor);
        self.homes.iter_mut().for_each(|home| home[..3].iter_mut().for_each(|v| *v *= factor));
    }
}
