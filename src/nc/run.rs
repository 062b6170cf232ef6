//! A block's actions in the order in which a control does them.

use super::action::{Action, Item};
use super::block::Block;
use super::codes::{Group, bit, letters};
use super::fault::{Done, refuse};
use super::out::{Next, Out};
use super::settings::Unpointed;
use super::state::{NO_MOTION, State, is_cycle};
use crate::control::{Meaning, Row, Rules};
use crate::diag::Code;
use crate::toolpath::{FeedMode, Units};

/// Words that are lengths or angles.
const LENGTHS: u32 = letters("XYZABCIJKRQ");

impl State {
    /// The words that need no code in their block. Where the control is not named, H beside a work offset does: on another
    /// control `G56 H1` is a length.
    fn free_words(&self, block: &Block) -> u32 {
        let free = self.control.traits().everywhere.bits();
        if self.settings.assumed && block.row(Group::Work).is_some() { free & !bit(b'H') } else { free }
    }

    /// Runs a block.
    ///
    /// # Errors
    /// What the control refuses.
    pub fn run(&mut self, block: &mut Block, line: u64, items: &mut Vec<Item>) -> Done<Next> {
        if self.control.rules() == Rules::Grbl {
            return self.grbl_block(block, &mut Out::new(items, line));
        }
        if !self.control.is_linuxcnc() && block.whole & LENGTHS != 0 {
            self.unpointed(block)?;
        }
        let motion = self.motion_of(block)?;
        let in_force = if self.control.is_linuxcnc() { None } else { self.holes.cycle };
        let row = in_force.or(motion).and_then(|code| self.motion_row(code));
        block.check_words(row, self.free_words(block))?;
        let mut out = Out::new(items, line);
        if let Some((start, end)) = block.comment {
            out.push(Action::Comment(start, end));
        }
        // most blocks only move
        if block.g(Group::FeedMode).is_some() {
            self.feed_mode(block, &mut out);
        }
        if let Some(feed) = block.get(b'F')
            && (self.modes.feed_mode != FeedMode::InverseTime || !self.control.is_linuxcnc())
        {
            self.drive.feed = feed;
        }
        let set_up = block.has(letters("ESTHD")) || block.has_m();
        if set_up || block.has_modes() {
            self.set_up(block, motion, &mut out)?;
        }
        if block.g_meaning(Group::Once) == Some(Meaning::Machine)
            && (block.has_axes() || matches!(motion, Some(20 | 30)) || self.control.is_linuxcnc())
            && (!matches!(motion, Some(0 | 10)) || in_force.is_some() || begins_cycle(block))
        {
            return refuse(Code::PN006, "G53 without G0 or G1", "write G0 with it, and end a cycle with G80 before");
        }
        if block.axes_are_taken() || block.g(Group::Once).is_some() {
            self.once(block, &mut out)?;
        }
        if self.control.is_linuxcnc() {
            if let Some(code) = motion {
                self.move_by(code, row, block, &mut out)?;
            }
        } else {
            self.move_by_fanuc(motion, block, &mut out)?;
        }
        self.finish(block, &mut out)
    }

    /// The rest of a block, which is as it was.
    ///
    /// # Errors
    /// What the control refuses.
    pub fn run_on(&mut self, block: &Block, line: u64, items: &mut Vec<Item>) -> Done<Next> {
        let mut out = Out::new(items, line);
        self.make_holes(block, &mut out)?;
        self.finish(block, &mut out)
    }

    /// M codes come when everything else is done.
    #[inline]
    fn finish(&mut self, block: &Block, out: &mut Out<'_>) -> Done<Next> {
        if self.holes.work.is_some() {
            return Ok(Next::Rest);
        }
        if block.has_m() { self.after(block, out) } else { Ok(Next::On) }
    }

    /// Lengths without a point.
    fn unpointed(&self, block: &mut Block) -> Done {
        let said = block.g_meaning(Group::Units).map(|meaning| meaning == Meaning::Inch);
        let inch = said.unwrap_or(self.modes.units == Units::Inch);
        let own = matches!(block.g_meaning(Group::Motion), Some(Meaning::ThreadCycle));
        if own || block.g(Group::Other).is_some() || block.means(Meaning::Orient) {
            return Ok(()); // their words are no lengths
        }
        let cycle =
            block.g(Group::Cycle).or(self.holes.cycle).is_some_and(|code| !matches!(code, NO_MOTION | 760 | 870));
        let whole = block.whole & LENGTHS & if cycle { !bit(b'K') } else { !0 };
        for letter in (b'A'..=b'Z').filter(|&letter| whole & bit(letter) != 0) {
            let Some(value) = block.get(letter).filter(|&value| value != 0.0) else { continue };
            match self.settings.unpointed {
                Unpointed::Whole => {}
                Unpointed::Increments => {
                    let increment = if inch && !letters("ABC") & bit(letter) != 0 { 1e-4 } else { 1e-3 };
                    block.set(letter, value * increment);
                }
                Unpointed::Refused => {
                    let name = char::from(letter);
                    let message =
                        format!("{name}{value} has no point, and its meaning depends on a setting of the control");
                    let help =
                        format!("write {name}{value}. for whole units, or say `--no-point whole` or `increments`");
                    return refuse(Code::PN017, message, help);
                }
            }
        }
        Ok(())
    }

    /// The motion code that a block runs, if any.
    fn motion_of(&self, block: &Block) -> Done<Option<u16>> {
        let word = block.g(Group::Motion);
        let moves = block.has_axes() && !block.axes_are_taken();
        if word.is_none() && !moves {
            if block.axes_are_taken() {
                return Ok(None);
            }
            // on a Fanuc a cycle runs for an R alone too, and a whole circle for its centre alone
            let cycle = block.g(Group::Cycle).is_some() || self.holes.cycle.is_some();
            let circle = !cycle && matches!(self.modes.motion, 20 | 30) && block.has(letters("IJK"));
            let runs = !self.control.is_linuxcnc() && (circle || cycle && block.has(bit(b'R')));
            return Ok(runs.then_some(self.modes.motion));
        }
        if let Some(code) = word.filter(|&code| code != NO_MOTION) {
            if block.has_axes() && block.axes_are_taken() && self.control.is_linuxcnc() {
                let help = "write them in two blocks";
                return refuse(Code::PN004, "two codes that both use the axis words", help);
            }
            let needs_axes = is_cycle(code) || matches!(code, 330 | 331) || code == 760 && !self.control.is_lathe();
            if needs_axes && !block.has_axes() {
                return refuse(Code::PN006, "the code needs axis words and has none", "write where, as X and Y");
            }
            return Ok(Some(code));
        }
        if !self.control.is_linuxcnc() {
            let in_cycle = match block.g(Group::Cycle) {
                Some(code) => code != NO_MOTION,
                None => self.holes.cycle.is_some(),
            };
            if self.modes.motion == NO_MOTION && !in_cycle {
                return no_motion("no G0 or G1 says how to go there");
            }
            return Ok(Some(self.modes.motion));
        }
        match word {
            Some(_) if moves => no_motion("axis words with G80"),
            Some(code) => Ok(Some(code)),
            None if self.modes.motion == NO_MOTION => no_motion("no motion code is in force"),
            None => Ok(Some(self.modes.motion)),
        }
    }

    fn move_by(&mut self, code: u16, row: Option<&'static Row>, block: &Block, out: &mut Out<'_>) -> Done {
        let moved = match code {
            0 | 10 => self.straight(code, block, out),
            20 | 30 => self.arc(code, block, out),
            330 => self.synchronised(block, out),
            331 => self.rigid_tap(block, out),
            760 => self.thread(block, out),
            NO_MOTION => Ok(()),
            _ => return self.linuxcnc_cycle(code, block, out),
        };
        debug_assert!(row.is_some());
        self.leave_cycle(code, out);
        moved
    }

    fn move_by_fanuc(&mut self, motion: Option<u16>, block: &Block, out: &mut Out<'_>) -> Done {
        if let Some(code) = block.g(Group::Cycle) {
            if block.g(Group::Motion).is_some() && code != NO_MOTION {
                let help = "write G0 or G1 in a block of its own";
                return refuse(Code::PN004, "a motion code and a cycle in one block", help);
            }
            if code == NO_MOTION {
                self.leave_cycle(self.modes.motion, out);
            } else {
                self.enter_fanuc_cycle(code);
            }
        }
        if let Some(code) = block.g(Group::Motion) {
            self.leave_cycle(code, out);
        }
        if block.axes_are_taken() {
            // G0 G28 X0: the word is of G28, and G0 is for the blocks behind it
            let help = "write the cycle in a block of its own";
            return if begins_cycle(block) {
                refuse(Code::PN004, "two codes that both use the axis words", help)
            } else {
                Ok(())
            };
        }
        if let (Some(code), true) = (self.holes.cycle, motion.is_some() || block.g(Group::Cycle).is_some()) {
            return self.fanuc_cycle(code, block, out);
        }
        match motion {
            Some(760) if self.control.is_lathe() && !block.has_axes() => self.first_block(block),
            Some(_) if !block.has_axes() && !block.has(letters("IJKR")) => Ok(()),
            Some(code @ (0 | 10)) => self.straight(code, block, out),
            Some(code @ (20 | 30)) => self.arc(code, block, out),
            Some(code @ (320 | 760 | 920)) if self.control.is_lathe() => self.lathe_thread(code, block, out),
            _ => Ok(()),
        }
    }

    /// A motion that is no cycle: the series is over.
    fn leave_cycle(&mut self, code: u16, out: &mut Out<'_>) {
        if self.cycle_in_force().is_some() {
            out.push(Action::CycleOff);
        }
        self.modes.motion = code;
        self.holes.cycle = None;
        self.holes.series.end();
    }
}

/// Does the block begin a canned cycle of a Fanuc?
fn begins_cycle(block: &Block) -> bool {
    block.g(Group::Cycle).is_some_and(|code| code != NO_MOTION)
}

fn no_motion<T>(message: &str) -> Done<T> {
    refuse(Code::PN006, message, "write G0, G1 or the cycle's code in this block")
}
