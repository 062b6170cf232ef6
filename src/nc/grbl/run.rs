//! Runs the codes of a block in the order in which Grbl runs them.

use super::check::check;
use super::error::refuse;
use crate::control::Meaning;
use crate::nc::action::{Action, Rotation};
use crate::nc::block::Block;
use crate::nc::codes::{Group, Motion};
use crate::nc::fault::Done;
use crate::nc::out::{Next, Out};
use crate::nc::state::State;
use crate::toolpath::{Coolant, Direction, FeedMode, Plane, StopKind, Units};

impl State {
    /// Runs a block. A refused block has no effect.
    pub(in crate::nc) fn grbl_block(&mut self, block: &Block, out: &mut Out<'_>) -> Done<Next> {
        let done = self.grbl_actions(block, out);
        if done.is_err() {
            out.take_back();
        }
        done
    }

    fn grbl_actions(&mut self, block: &Block, out: &mut Out<'_>) -> Done<Next> {
        let motion = check(block, self)?;
        if let Some((start, end)) = block.comment {
            out.push(Action::Comment(start, end));
        }
        self.grbl_feed(block, motion, out)?;
        let frame_goes = block.g_meaning(Group::Once) == Some(Meaning::FrameOff);
        if !frame_goes {
            self.once(block, out)?;
        }
        if let Some(row) = block.row(Group::Motion) {
            self.modes.motion = Some(row).filter(|row| row.meaning != Meaning::CycleEnd);
        }
        match motion.map(|row| row.meaning) {
            Some(Meaning::Rapid) => self.straight(true, block, out)?,
            Some(Meaning::Line) => self.straight(false, block, out)?,
            Some(Meaning::ArcCw) => self.grbl_arc(Direction::Cw, block, out)?,
            Some(Meaning::ArcCcw) => self.grbl_arc(Direction::Ccw, block, out)?,
            Some(Meaning::Probe) => self.probe(block, out)?,
            Some(_) => return refuse(20),
            None => {}
        }
        if frame_goes {
            self.once(block, out)?;
        }
        if block.check_words(motion, self.control.traits().everywhere.bits()).is_err() {
            return refuse(36);
        }
        self.grbl_stops(block, out);
        Ok(Next::On)
    }

    /// Sets the feed and all other values that take effect before the axis words. Grbl stores F in millimetres. F is in
    /// the units of its block; but in the block that ends G93, Grbl reads F as millimetres.
    fn grbl_feed(&mut self, block: &Block, motion: Motion, out: &mut Out<'_>) -> Done {
        let before = self.modes.feed_mode;
        if block.row(Group::FeedMode).is_some() {
            self.feed_mode(block, out);
        }
        let feed = block.get(b'F').filter(|_| self.modes.feed_mode != FeedMode::InverseTime);
        if let Some(feed) = feed {
            self.drive.set_feed(feed);
        }
        self.set_up(block, motion, out)?;
        if let Some(feed) = feed {
            let is_mm = before == FeedMode::InverseTime && self.modes.units == Units::Inch;
            self.drive.set_feed(if is_mm { feed / 25.4 } else { feed });
        }
        Ok(())
    }

    /// Runs G38. The probing move goes to its end, as if the probe touches nothing. The contact position is known only
    /// at the machine.
    fn probe(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let feed = self.drive.feed_of(block, self.modes.feed_mode)?;
        let (from, to) = (self.place.position, self.target(block)?);
        if from == to {
            return refuse(33);
        }
        self.place.feed_to(to, feed, None, out);
        for axis in (0..3).filter(|&axis| from[axis] != to[axis]) {
            self.place.becomes_unknown(1 << axis);
        }
        Ok(())
    }

    /// Runs M0, M2 and M30. Senders may send more blocks after the end of the program. Grbl runs these blocks, with
    /// some modes reset to their values at power-up.
    fn grbl_stops(&mut self, block: &Block, out: &mut Out<'_>) {
        for (_, row) in block.m() {
            match row.meaning {
                Meaning::StopProgram => out.push(Action::Stop(StopKind::Program)),
                Meaning::StopOptional => out.push(Action::LeftOut(row.code, row.meaning)),
                Meaning::End => self.grbl_end(out),
                _ => {}
            }
        }
    }

    fn grbl_end(&mut self, out: &mut Out<'_>) {
        self.modes.motion = self.control.first(Meaning::Line);
        self.modes.absolute = true;
        if self.modes.plane != Plane::Xy {
            self.modes.plane = Plane::Xy;
            out.push(Action::Plane(Plane::Xy));
        }
        if self.modes.feed_mode != FeedMode::PerMinute {
            (self.modes.feed_mode, self.drive.feed) = (FeedMode::PerMinute, 0.0);
            out.push(Action::FeedMode(FeedMode::PerMinute));
        }
        if self.place.frames.active != 1 {
            self.place.reframe(|frames| frames.active = 1);
            out.push(Action::Work(54.0));
        }
        if self.drive.spindle != Rotation::Stop {
            self.drive.spindle = Rotation::Stop;
            out.push(Action::Spindle(Rotation::Stop, self.drive.speed));
        }
        out.push(Action::Coolant(Coolant::OFF));
        out.push(Action::End);
    }
}
