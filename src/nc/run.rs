//! Runs the codes of a block in the order in which the control runs them.

use super::action::{Action, Item};
use super::block::Block;
use super::codes::{ARCS, Group, Motion, STRAIGHT, bit, is_one_of, letters};
use super::fault::{Done, refuse};
use super::out::{Next, Out};
use super::state::State;
use super::stops::{runs_last, stops};
use super::unpointed::SCALED;
use crate::control::{Meaning, Row, Rules};
use crate::diag::Code;
use crate::toolpath::{Direction, FeedMode};

impl State {
    /// The words that need no code in their block. If the control is only assumed, H in a block with a work offset
    /// needs a code, because `G56 H1` selects a tool length on some controls.
    fn free_words(&self, block: &Block) -> u32 {
        let free = self.control.traits().everywhere.bits();
        if self.settings.assumed && block.row(Group::Work).is_some() { free & !bit(b'H') } else { free }
    }

    /// Runs a block.
    ///
    /// # Errors
    /// The control refuses the block.
    #[inline]
    pub fn run(&mut self, block: &mut Block, line: u64, items: &mut Vec<Item>) -> Done<Next> {
        if self.control.rules() == Rules::Grbl {
            return self.grbl_block(block, &mut Out::new(items, line));
        }
        if block.plain && self.cuts_plainly(block, &mut Out::new(items, line)) {
            return Ok(Next::On);
        }
        let next = self.run_codes(block, line, items)?;
        self.check_read(block, next)
    }

    /// Refuses a word whose value no code has read when the block is complete. LinuxCNC has rules of its own for such
    /// words; `Block::check_words` has these rules.
    fn check_read(&self, block: &Block, next: Next) -> Done<Next> {
        if !matches!(next, Next::Rest) && !self.control.is_linuxcnc() {
            block.check_read(letters("NO"))?;
        }
        Ok(next)
    }

    fn run_codes(&mut self, block: &mut Block, line: u64, items: &mut Vec<Item>) -> Done<Next> {
        let alike = std::mem::take(&mut self.holes.alike);
        if !self.control.is_linuxcnc() && block.whole & SCALED != 0 {
            self.unpointed(block)?;
        }
        let motion = self.motion_of(block)?;
        let in_force = if self.control.is_linuxcnc() { None } else { self.holes.cycle };
        block.check_words(in_force.or(motion), self.free_words(block))?;
        if self.turning.corner.is_some() && !block.is_empty {
            self.check_after_corner(motion, block)?;
        }
        let mut out = Out::new(items, line);
        if let Some((start, end)) = block.comment {
            out.push(Action::Comment(start, end));
        }
        // most blocks only move, so they have none of these codes
        if block.row(Group::FeedMode).is_some() {
            self.feed_mode(block, &mut out);
        }
        if let Some(feed) = block.get(b'F')
            && (self.modes.feed_mode != FeedMode::InverseTime || !self.control.is_linuxcnc())
        {
            self.drive.set_feed(feed);
        }
        let set_up = block.has(letters("ESTHD")) || block.has_m() || block.work.is_some();
        if set_up || block.has_modes() {
            self.set_up(block, motion, &mut out)?;
        }
        self.check_rotary(block, motion)?;
        if block.g_meaning(Group::Once) == Some(Meaning::Machine)
            && (block.has_axes() || is_one_of(motion, &ARCS) || self.control.is_linuxcnc())
            // except on LinuxCNC, G0 or G1 in the block ends an active cycle
            && (!is_one_of(motion, &STRAIGHT)
                || in_force.is_some() && (self.control.is_linuxcnc() || block.row(Group::Motion).is_none())
                || begins_cycle(block))
        {
            return refuse(
                Code::PN006,
                "G53 without G0 or G1",
                "write G0 in the block of G53; if a cycle is active, end it with G80 first",
            );
        }
        if block.axes_are_taken() || block.row(Group::Once).is_some() {
            self.once(block, &mut out)?;
            self.threads.end_passes(block.g_meaning(Group::Once));
            if self.control.is_lathe()
                && let Some(asked) = self.turning_cycle(block, &mut out)?
            {
                if let Some((code, _)) = block.m().find(|(_, row)| runs_last(row.meaning)) {
                    let message = format!("M{code} in the block of a turning cycle would take effect after the cycle");
                    return refuse(Code::PN016, message, "write the code in a block after the cycle");
                }
                return Ok(Next::Profile(asked));
            }
        }
        if self.control.is_linuxcnc() {
            if let Some(row) = motion {
                self.move_by(row, block, &mut out)?;
            }
        } else {
            self.move_by_fanuc(motion, block, &mut out)?;
            self.check_stops_at_hole(motion, block)?;
            if let Some(call) = &block.call {
                self.call_cycle(call, &mut out)?;
            }
            if let Some(pattern) = block.pattern.take() {
                self.holes.pattern = Some(pattern);
                self.make_pattern(&mut out)?;
            }
        }
        self.holes.alike = if self.makes_hole_by_position(block) { alike.saturating_add(1) } else { 0 };
        self.finish(block, &mut out)
    }

    /// Refuses a code that stops the spindle, the coolant or the program in a block that makes a hole. Most blocks run
    /// such a code last, but a Fanuc runs it before the tool goes down, and a Siemens before it calls the modal cycle.
    fn check_stops_at_hole(&self, motion: Motion, block: &Block) -> Done {
        let of_fanuc = self.holes.cycle.is_some() && (motion.is_some() || begins_cycle(block));
        if !block.has_m() || !of_fanuc && block.call.is_none() && block.pattern.is_none() {
            return Ok(());
        }
        let Some((code, _)) = block.m().find(|(_, row)| stops(row.meaning)) else { return Ok(()) };
        let message = format!("M{code} in a block that makes a hole takes effect before the hole on some controls");
        refuse(Code::PN016, message, format!("write M{code} in a block of its own, after the hole"))
    }

    /// Continues a block that stopped because its output was full. The block must be unchanged.
    ///
    /// # Errors
    /// The control refuses the block.
    pub fn run_on(&mut self, block: &Block, line: u64, items: &mut Vec<Item>) -> Done<Next> {
        let mut out = Out::new(items, line);
        self.make_holes(block, &mut out)?;
        self.make_pattern(&mut out)?;
        let next = self.finish(block, &mut out)?;
        self.check_read(block, next)
    }

    /// Runs the M codes that take effect after everything else in the block.
    #[inline]
    fn finish(&mut self, block: &Block, out: &mut Out<'_>) -> Done<Next> {
        if self.holes.work.is_some() || self.holes.pattern.is_some() {
            return Ok(Next::Rest);
        }
        if block.has_m() { self.after(block, out) } else { Ok(Next::On) }
    }

    /// The canned cycle of a Fanuc that this block begins, or that is active.
    pub(super) fn cycle_of(&self, block: &Block) -> Motion {
        match block.row(Group::Cycle) {
            Some(row) => Some(row).filter(|row| row.meaning != Meaning::CycleEnd),
            None => self.holes.cycle,
        }
    }

    /// The code of the motion that a block makes; `None`: the block does not move. If no motion is active, the result
    /// is the code of the active cycle.
    fn motion_of(&self, block: &Block) -> Done<Motion> {
        let word = block.row(Group::Motion);
        let moves = block.has_axes() && !block.axes_are_taken();
        if word.is_none() && !moves {
            if block.axes_are_taken() || self.control.is_linuxcnc() {
                return Ok(None);
            }
            // on a Fanuc, R alone runs the active cycle; I, J or K alone makes a full circle
            let has_cycle = block.row(Group::Cycle).is_some() || self.holes.cycle.is_some();
            let circle = !has_cycle && is_one_of(self.modes.motion, &ARCS) && block.has(letters("IJK"));
            let runs = circle || has_cycle && block.has(bit(b'R'));
            return Ok(self.modes.motion.or(self.cycle_of(block)).filter(|_| runs));
        }
        if let Some(row) = word.filter(|row| row.meaning != Meaning::CycleEnd) {
            if block.has_axes() && block.axes_are_taken() && self.control.is_linuxcnc() {
                let help = "write the codes in two blocks";
                return refuse(Code::PN004, "two codes that both use the axis words", help);
            }
            let needs_axes = match row.meaning {
                Meaning::Cycle => true,
                Meaning::Thread | Meaning::RigidTap | Meaning::ThreadCycle => !self.control.is_lathe(),
                _ => false,
            };
            if needs_axes && !block.has_axes() {
                return refuse(Code::PN006, "the code needs axis words and has none", "write the position, as X and Y");
            }
            return Ok(Some(row));
        }
        if !self.control.is_linuxcnc() {
            return match self.modes.motion.or(self.cycle_of(block)) {
                None => no_motion("no motion code is active: G0 or G1 is missing"),
                motion => Ok(motion),
            };
        }
        match word {
            Some(_) if moves => no_motion("axis words with G80"),
            None if self.modes.motion.is_none() => no_motion("no motion code is active"),
            None => Ok(self.modes.motion),
            end => Ok(end),
        }
    }

    fn move_by(&mut self, row: &'static Row, block: &Block, out: &mut Out<'_>) -> Done {
        let moved = match row.meaning {
            Meaning::Rapid => self.straight(true, block, out),
            Meaning::Line => self.straight(false, block, out),
            Meaning::ArcCw => self.arc(Direction::Cw, block, out),
            Meaning::ArcCcw => self.arc(Direction::Ccw, block, out),
            Meaning::Thread => self.synchronised(false, block, out),
            Meaning::RigidTap => self.rigid_tap(block, out),
            Meaning::ThreadCycle => self.thread(block, out),
            Meaning::Cycle => return self.linuxcnc_cycle(row, block, out),
            Meaning::Probe => self.probe_of_linuxcnc(block, out),
            Meaning::CycleEnd => Ok(()),
            _ => {
                return refuse(
                    Code::PN016,
                    format!("{} is not a motion of {}", row.code, self.control.name()),
                    "run the program without this code",
                );
            }
        };
        self.leave_cycle(row, out);
        moved
    }

    fn move_by_fanuc(&mut self, motion: Motion, block: &Block, out: &mut Out<'_>) -> Done {
        if let Some(row) = block.row(Group::Cycle) {
            let begins = row.meaning != Meaning::CycleEnd;
            if block.row(Group::Motion).is_some() && begins {
                let help = "write G0 or G1 in a separate block";
                return refuse(Code::PN004, "a motion code and a cycle in one block", help);
            }
            if begins {
                self.enter_fanuc_cycle(row);
            } else {
                self.end_cycle(out);
            }
        }
        if let Some(row) = block.row(Group::Motion) {
            self.leave_cycle(row, out);
        }
        if block.axes_are_taken() {
            // in `G0 G28 X0`, the axis word belongs to G28; G0 is active for the next blocks
            let help = "write the cycle in a separate block";
            return if begins_cycle(block) {
                refuse(Code::PN004, "two codes that both use the axis words", help)
            } else {
                Ok(())
            };
        }
        if let (Some(row), true) = (self.holes.cycle, motion.is_some() || block.row(Group::Cycle).is_some()) {
            return self.fanuc_cycle(row, block, out);
        }
        let Some(row) = motion else { return Ok(()) };
        let lathe = self.control.is_lathe();
        if lathe && row.meaning == Meaning::ThreadCycle && !block.has_axes() {
            return self.first_block(block);
        }
        if !block.has_axes() && !block.has(letters("IJKR")) {
            return Ok(());
        }
        match row.meaning {
            Meaning::Rapid => self.straight(true, block, out),
            Meaning::Line => self.straight(false, block, out),
            Meaning::ArcCw => self.arc(Direction::Cw, block, out),
            Meaning::ArcCcw => self.arc(Direction::Ccw, block, out),
            Meaning::Thread | Meaning::ThreadCycle | Meaning::ThreadPass if lathe => {
                self.lathe_thread(row.meaning, block, out)
            }
            Meaning::TurnPass | Meaning::FacePass if lathe => self.turning_pass(row.meaning, block, out),
            _ => refuse(
                Code::PN016,
                format!("{} is not a motion of {}", row.code, self.control.name()),
                "run the program without this code",
            ),
        }
    }

    /// Ends the series of holes, because the motion is not a cycle.
    fn leave_cycle(&mut self, row: &'static Row, out: &mut Out<'_>) {
        self.end_cycle(out);
        self.threads.end_passes(Some(row.meaning));
        // G76 of a lathe takes effect only in its block
        if !(self.control.is_lathe() && row.meaning == Meaning::ThreadCycle) {
            self.modes.motion = Some(row).filter(|row| row.meaning != Meaning::CycleEnd);
        }
    }

    /// Ends the active cycle. The modal motion does not change.
    fn end_cycle(&mut self, out: &mut Out<'_>) {
        if self.cycle_in_force().is_some() {
            out.push(Action::CycleOff);
        }
        self.holes.cycle = None;
        self.holes.series.end();
    }
}

/// Whether the block begins a canned cycle of a Fanuc.
fn begins_cycle(block: &Block) -> bool {
    block.g_meaning(Group::Cycle).is_some_and(|meaning| meaning != Meaning::CycleEnd)
}

fn no_motion<T>(message: &str) -> Done<T> {
    refuse(Code::PN006, message, "write G0, G1 or the cycle's code in this block")
}
