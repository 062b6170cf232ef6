//! Straight moves: the targets of axis words, G0, G1, G53 and G33.

use super::action::{Action, Position, Rotation, only_turns};
use super::block::Block;
use super::codes::{Group, bit, letters};
use super::fault::{Done, refuse};
use super::out::Out;
use super::state::State;
use crate::control::{Meaning, Rules};
use crate::diag::Code;
use crate::toolpath::{FeedMode, Plane};

impl State {
    /// The value of an axis word as a length. If X is a diameter, its value is halved.
    #[inline]
    pub(super) fn axis_word(&self, block: &Block, axis: usize) -> Option<f64> {
        let value = block.get(self.control.axes()[axis])?;
        Some(if self.modes.diameter && axis == 0 { value / 2.0 } else { value })
    }

    /// Whether the word of an axis is a position, not an increment.
    #[inline]
    pub(super) fn is_absolute(&self, block: &Block, axis: usize) -> bool {
        let at = 1 << axis;
        block.absolute & at != 0 || self.modes.absolute && block.incremental & at == 0
    }

    /// Bit mask of the axes for which a block contains positions.
    pub(super) fn said_positions(&self, block: &Block) -> u8 {
        let polar = if block.polar == [None; 2] { 0 } else { 0b11 };
        let said = |axis: &usize| self.axis_word(block, *axis).is_some() && self.is_absolute(block, *axis);
        (0..6).filter(said).fold(if self.modes.absolute { polar } else { 0 }, |said, axis| said | 1 << axis)
    }

    /// The target of the axis words of a block, in program coordinates.
    #[inline]
    pub(super) fn target(&mut self, block: &Block) -> Done<Position> {
        let mut to = self.place.position;
        for (axis, place) in to.iter_mut().enumerate() {
            let Some(value) = self.axis_word(block, axis) else { continue };
            if self.is_absolute(block, axis) {
                *place = value;
                // on a FADAL, Z is in machine coordinates while no tool length offset is active
                match axis == 2 && self.control.traits().height_is_machine && !self.tool.length_on {
                    true => {
                        *place -= self.place.frames.zero_height();
                        self.place.goes_home(0b100);
                    }
                    false => self.place.given(axis),
                }
            } else {
                *place += value;
                self.place.moves_by(axis, value);
            }
        }
        if block.polar != [None; 2] {
            self.polar(block, &mut to)?;
            if self.modes.absolute && block.polar.iter().all(Option::is_some) {
                (0..2).for_each(|axis| self.place.given(axis));
            }
        }
        if self.control.is_lathe() {
            for (axis, place) in to.iter_mut().enumerate() {
                let Some(by) = self.increment(block, axis) else { continue };
                if self.axis_word(block, axis).is_some() {
                    let [position, increment] = [["X", "U"], ["Y", "V"], ["Z", "W"]][axis];
                    let message = format!("{position} and {increment} in one block");
                    return refuse(Code::PN004, message, "write one of them: a control uses only one");
                }
                *place += by;
                self.place.moves_by(axis, by);
            }
        }
        Ok(to)
    }

    /// The value of an incremental word of a lathe: U along X, as a diameter, or W along Z.
    pub(super) fn increment(&self, block: &Block, axis: usize) -> Option<f64> {
        let letter = [b'U', b'V', b'W'].get(axis).filter(|_| self.control.is_lathe())?;
        let value = block.get(*letter)?;
        Some(if self.modes.diameter && axis == 0 { value / 2.0 } else { value })
    }

    /// Applies polar coordinates: `@` is the radius, `^` is the angle.
    pub(super) fn polar(&self, block: &Block, to: &mut Position) -> Done {
        if self.modes.plane != Plane::Xy {
            return refuse(Code::PN005, "polar coordinates outside G17", "write G17 first");
        }
        if block.has(bit(b'X') | bit(b'Y')) {
            return refuse(
                Code::PN005,
                "polar coordinates and X or Y in one block",
                "write either polar coordinates, or X and Y",
            );
        }
        let [x, y, ..] = self.place.position;
        let (mut radius, mut angle) = (x.hypot(y), y.atan2(x).to_degrees());
        match (self.modes.absolute, block.polar) {
            (true, [_, None]) if x == 0.0 && y == 0.0 => {
                return refuse(Code::PN018, "a polar radius at the origin without its angle", "write ^ in this block");
            }
            (true, [r, a]) => (radius, angle) = (r.unwrap_or(radius), a.unwrap_or(angle)),
            (false, _) if x == 0.0 && y == 0.0 => {
                return refuse(
                    Code::PN018,
                    "polar increments at the origin",
                    "an angle is not possible at the origin: write G90",
                );
            }
            (false, [r, a]) => (radius, angle) = (radius + r.unwrap_or(0.0), angle + a.unwrap_or(0.0)),
        }
        let (sin, cos) = angle.to_radians().sin_cos();
        to[0] = radius * cos;
        to[1] = radius * sin;
        Ok(())
    }

    /// Makes a rapid or a straight feed move.
    #[inline]
    pub(super) fn straight(&mut self, rapid: bool, block: &Block, out: &mut Out<'_>) -> Done {
        if block.g_meaning(Group::Once) == Some(Meaning::Machine) {
            return self.in_machine(rapid, block, out);
        }
        if rapid {
            let to = self.target(block)?;
            self.place.rapid_to(to, out);
            return Ok(());
        }
        if self.control.is_lathe() && block.has(letters("AC")) && block.has(letters("XZUW")) {
            let message = "A or C in a straight cut of a lathe can be an angle, a chamfer or an axis";
            return refuse(Code::PN016, message, "write the points of the corner; turn an axis in a separate block");
        }
        let feed = self.drive.feed_of(block, self.modes.feed_mode)?;
        if self.control.is_lathe() {
            return self.cut_with_corners(block, feed, out);
        }
        let from = self.place.position;
        let to = self.target(block)?;
        let feed = if only_turns(&from, &to) { self.feed_of_turn(feed)? } else { feed };
        self.place.feed_to(to, feed, None, out);
        Ok(())
    }

    /// The feed of a cut that only turns the part, in degrees. LinuxCNC keeps the number of F if the units change.
    ///
    /// # Errors
    /// The units have changed since the program gave F, and no public source defines the feed on this control.
    fn feed_of_turn(&self, feed: f64) -> Done<f64> {
        let given = self.drive.given_feed;
        if self.modes.feed_mode == FeedMode::InverseTime || given == self.drive.feed {
            return Ok(feed);
        }
        if !self.control.is_linuxcnc() {
            let message = "the part turns with a feed that was given before the units changed";
            return refuse(Code::PN016, message, "write F again after the code for the units");
        }
        Ok(given)
    }

    /// Runs G38: a move towards a position until the probe touches. The contact position is known only at the machine.
    pub(super) fn probe_of_linuxcnc(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        if self.tool.side.is_some() {
            return refuse(Code::PN013, "a probe under cutter compensation", "end the compensation with G40 first");
        }
        let feed = self.drive.feed_of(block, self.modes.feed_mode)?;
        let (from, to) = (self.place.position, self.target(block)?);
        let moved: u8 =
            (0..3).filter(|&axis| from[axis] != to[axis] || self.is_unknown(axis)).map(|axis| 1 << axis).sum();
        if moved & self.named(block) == 0 {
            return refuse(Code::PN006, "a probe without a position", "write a position, as Z-20");
        }
        self.place.feed_home(to, moved & self.named(block), feed, out);
        self.place.becomes_unknown(moved & self.named(block));
        Ok(())
    }

    /// Bit mask of the linear axes for which the block has words.
    fn named(&self, block: &Block) -> u8 {
        (0..3).filter(|&axis| self.axis_word(block, axis).is_some()).map(|axis| 1 << axis).sum()
    }

    /// Runs G53: the axis words are machine coordinates.
    fn in_machine(&mut self, rapid: bool, block: &Block, out: &mut Out<'_>) -> Done {
        if !self.modes.absolute && self.control.rules() != Rules::Grbl {
            return refuse(Code::PN018, "G53 under G91", "write G90 in the block: an increment would have no start");
        }
        if self.tool.side.is_some() {
            return refuse(Code::PN013, "G53 under cutter compensation", "end the compensation with G40 first");
        }
        let mut place = self.place.frames.to_machine(&self.place.position);
        let mut named = 0;
        for (axis, coordinate) in place.iter_mut().enumerate() {
            if let Some(value) = self.axis_word(block, axis) {
                *coordinate = value;
                named |= 1 << axis;
            }
        }
        let mut to = self.place.frames.to_program(&place);
        // in a rotated frame, a machine move along X changes both X and Y of the program
        let turned = if self.place.frames.angle() == 0.0 { 0 } else { 0b11 };
        for axis in (0..6).filter(|axis| (named | turned) & 1 << axis == 0) {
            to[axis] = self.place.position[axis];
        }
        match block.hidden {
            true => self.place.goes_to_machine(named),
            false => self.place.goes_home(named),
        }
        // a Fanuc makes this move at rapid, even if another motion is active
        if rapid || self.control.rules() == Rules::Fanuc {
            self.place.rapid_to(to, out);
        } else {
            let feed = self.drive.feed_of(block, self.modes.feed_mode)?;
            self.place.feed_home(to, named, feed, out);
        }
        let ends_length = block.row(Group::Once).map_or(0, |row| row.runs.ends_length);
        self.end_length(named & ends_length, out);
        Ok(())
    }

    /// Runs G33.1: the tap follows the spindle into the hole, the spindle reverses, and the tap follows the spindle
    /// back to the start, at I times the speed.
    pub(super) fn rigid_tap(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let (begin, turning, unknown) = (self.place.position, self.drive.spindle, self.place.at_machine);
        if turning == Rotation::Stop {
            return refuse(Code::PN012, "G33.1 with the spindle stopped", "write M3 or M4 before G33.1");
        }
        let faster = block.get(b'I').unwrap_or(1.0);
        if faster <= 0.0 {
            let message = format!("I{faster} of G33.1 is not a multiplier of the speed");
            return refuse(Code::PN018, message, "write an I greater than 0, or leave it out");
        }
        self.synchronised(true, block, out)?;
        out.push(Action::Spindle(turning.reversed(), self.drive.speed * faster));
        self.place.at_machine = unknown;
        self.place.feed_to(begin, self.drive.feed, block.get(b'K'), out);
        out.push(Action::Spindle(turning, self.drive.speed));
        Ok(())
    }

    /// Runs G33: a move that follows the spindle. If the move is a tap (`taps`), rotary axes do not move.
    pub(super) fn synchronised(&mut self, taps: bool, block: &Block, out: &mut Out<'_>) -> Done {
        let Some(lead) = block.get(b'K') else {
            return refuse(Code::PN007, "G33 without K", "write K with the distance per revolution");
        };
        let mut to = self.target(block)?;
        if taps {
            to[3..].copy_from_slice(&self.place.position[3..]);
        }
        self.place.feed_to(to, self.drive.feed, Some(lead), out);
        Ok(())
    }
}
