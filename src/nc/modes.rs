//! The codes that take effect before the motion of a block: feed mode, dwell, plane, units, distance mode, work offset.

use super::action::Action;
use super::block::Block;
use super::codes::{Group, Motion, bit, letters};
use super::fault::{Done, refuse};
use super::frames::Frames;
use super::out::Out;
use super::state::State;
use crate::control::{DwellUnit, Meaning, Rules, WorkOffset};
use crate::diag::Code;
use crate::lang::additional_work;
use crate::toolpath::{FeedMode, Units};

impl State {
    pub(super) fn feed_mode(&mut self, block: &Block, out: &mut Out<'_>) {
        let mode = match block.g_meaning(Group::FeedMode) {
            Some(Meaning::InverseTime) => FeedMode::InverseTime,
            Some(Meaning::PerRev) => FeedMode::PerRev,
            _ => FeedMode::PerMinute,
        };
        // LinuxCNC forgets F at each feed mode code, other controls only when the mode changes
        if mode != FeedMode::InverseTime && (self.forgets_feed() || mode != self.modes.feed_mode) {
            self.drive.feed = 0.0;
        }
        if mode != self.modes.feed_mode {
            self.modes.feed_mode = mode;
            out.push(Action::FeedMode(mode));
        }
    }

    fn forgets_feed(&self) -> bool {
        matches!(self.control.rules(), Rules::Linuxcnc | Rules::Emc2)
    }

    /// Runs the codes that take effect after the feed and before the motion.
    pub(super) fn set_up(&mut self, block: &Block, motion: Motion, out: &mut Out<'_>) -> Done {
        self.compensated(block.means(Meaning::Output), "an output")?;
        self.compensated(block.changes_tool(), "a tool change")?;
        self.compensated(block.means(Meaning::Override), "a change of the override switches")?;
        self.spindle_and_tool(block, out)?;
        if block.g_meaning(Group::Once) == Some(Meaning::Dwell) {
            let times = b"PXU".iter().filter(|letter| block.has(bit(**letter))).count();
            if !self.control.is_linuxcnc() && (block.has(letters("YZABC")) || times > 1) {
                let help = "write the dwell in a separate block, with one time: P, or X";
                return refuse(Code::PN004, "G4 and axis words in one block", help);
            }
            let time = block.get(b'X').or(block.get(b'U'));
            let seconds = match (block.get(b'P'), time) {
                (Some(_), _) if self.control.traits().dwell == DwellUnit::Unknown => {
                    let message =
                        format!("the control file of {} does not give the unit of P of a dwell", self.control.name());
                    return refuse(
                        Code::PN016,
                        message,
                        "give the unit in a control file of your own: `[dwell]` and `P = \"s\"` or `\"ms\"`",
                    );
                }
                (Some(p), _) => self.seconds(p, block)?,
                (None, Some(x)) if !self.control.is_linuxcnc() => x,
                _ => return refuse(Code::PN007, "G4 without its time", "write G4 P1. for a second"),
            };
            if seconds < 0.0 {
                return refuse(Code::PN018, "a negative dwell", "write P without the minus");
            }
            out.push(Action::Dwell(seconds));
        }
        let plane = block.plane().unwrap_or(self.modes.plane);
        if plane != self.modes.plane {
            self.compensated(true, "another plane")?;
            self.modes.plane = plane;
            out.push(Action::Plane(plane));
        }
        let feed = block.get(b'F').filter(|_| !self.control.is_linuxcnc());
        match block.g_meaning(Group::Units) {
            Some(Meaning::Inch) => self.set_units(Units::Inch, feed, out),
            Some(Meaning::Mm) => self.set_units(Units::Mm, feed, out),
            _ => {}
        }
        if let Some(meaning) = block.g_meaning(Group::Diameter) {
            self.modes.diameter = meaning == Meaning::Diameter;
        }
        self.compensation(block, motion, out)?;
        for (group, what) in
            [(Group::Work, "a work offset"), (Group::Path, "a path mode"), (Group::Length, "another length offset")]
        {
            self.compensated(block.row(group).is_some(), what)?;
        }
        self.length(block, out)?;
        self.work_offset(block, out)?;
        if let Some(meaning) = block.g_meaning(Group::Distance) {
            self.modes.absolute = meaning == Meaning::Absolute;
        }
        if let Some(meaning) = block.g_meaning(Group::ArcDistance) {
            self.modes.centers_absolute = meaning == Meaning::CentresAbsolute;
            self.modes.centers_known = true;
        }
        if let Some(meaning) = block.g_meaning(Group::Return) {
            if self.tool.side.is_some() && self.control.is_linuxcnc() {
                return refuse(
                    Code::PN013,
                    "G98 or G99 under cutter compensation",
                    "end the compensation with G40 first",
                );
            }
            self.modes.to_initial = meaning == Meaning::ToInitial;
        }
        Ok(())
    }

    /// Converts P to seconds. P without a decimal point is in milliseconds, except on controls that use seconds. P with
    /// a decimal point is in seconds, but only on controls of the Fanuc kind that read such a P.
    ///
    /// # Errors
    /// P has a decimal point, and the control reads P only as a whole number. If the control is only assumed, such a P
    /// is in seconds, as on most controls.
    pub(super) fn seconds(&self, p: f64, block: &Block) -> Done<f64> {
        let dwell = self.control.traits().dwell;
        let has_point = !self.control.rules().is_nist() && block.whole & bit(b'P') == 0;
        if has_point && dwell == DwellUnit::Ms && !self.settings.assumed {
            let message = format!("P{p} with a decimal point: P of a dwell is a whole number of milliseconds");
            return refuse(Code::PN016, message, format!("write P{}", (p * 1000.0).round()));
        }
        Ok(if dwell == DwellUnit::S || has_point { p } else { p / 1000.0 })
    }

    /// If `changes` is set, refuses the change of a mode while cutter compensation is on, as LinuxCNC does.
    pub(super) fn compensated(&self, changes: bool, what: &str) -> Done {
        if !changes || self.tool.side.is_none() || !self.control.is_linuxcnc() {
            return Ok(());
        }
        refuse(Code::PN013, format!("{what} under cutter compensation"), "end the compensation with G40 first")
    }

    pub(super) fn set_units(&mut self, units: Units, feed: Option<f64>, out: &mut Out<'_>) {
        if units != self.modes.units {
            let factor = if units == Units::Inch { 1.0 / 25.4 } else { 25.4 };
            self.modes.units = units;
            self.place.scale(factor);
            if self.modes.feed_mode != FeedMode::InverseTime {
                self.drive.rescale_feed(factor);
            }
            // LinuxCNC reads F before the units of its block take effect, a Fanuc reads F after that
            if let Some(feed) = feed {
                self.drive.set_feed(feed);
            }
        }
        out.push(Action::Units(units));
    }

    pub(super) fn work_offset(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        if let Some(number) = block.work {
            self.counted_work(number, out);
            return Ok(());
        }
        let Some(offset) = block.row(Group::Work).and_then(|row| row.runs.work) else {
            if let Some(letter) = self.control.traits().work_letter
                && let Some(fixture) = block.get(letter)
            {
                let most = self.control.traits().most_work.map_or(f64::INFINITY, f64::from);
                if fixture.fract() != 0.0 || !(0.0..=most).contains(&fixture) {
                    let letter = char::from(letter);
                    let message = format!("there is no work offset {letter}{fixture}");
                    return refuse(Code::PN018, message, format!("write {letter}1 to {letter}{most}"));
                }
                self.counted_work(fixture, out);
            }
            return Ok(());
        };
        let additional = |number: f64| (9 + number as usize, additional_work(number));
        let (number, name) = match offset {
            WorkOffset::Usual(code) => (offset.usual().unwrap_or(1), f64::from(code) / 10.0),
            WorkOffset::Additional(number) => additional(f64::from(number)),
            WorkOffset::Counted(letter) => {
                let said = block.get(letter).filter(|number| number.fract() == 0.0 && *number >= 1.0);
                let Some(number) = said else {
                    let letter = char::from(letter);
                    return refuse(
                        Code::PN007,
                        "a work offset without its number",
                        format!("write {letter}1 in this block"),
                    );
                };
                self.counted_work(number, out);
                return Ok(());
            }
            WorkOffset::Word(letter) => {
                let most = f64::from(WorkOffset::MOST);
                let said = block.get(letter).filter(|number| number.fract() == 0.0 && (1.0..=most).contains(number));
                let Some(number) = said else {
                    let (name, letter) = (block.get(letter), char::from(letter));
                    let help = format!("write {letter}1 to {letter}{most} in this block");
                    let message = match name {
                        None => "an additional work offset without its number".to_owned(),
                        Some(other) => {
                            format!("postform knows no work offset {letter}{other}, only {letter}1 to {letter}{most}")
                        }
                    };
                    return refuse(Code::PN007, message, help);
                };
                additional(number)
            }
        };
        self.place.reframe(|frames| frames.active = number);
        self.work_is(name, out);
        Ok(())
    }

    /// Selects a work offset on a control whose work offsets have numbers but no codes.
    fn counted_work(&mut self, number: f64, out: &mut Out<'_>) {
        self.place.reframe(|frames| frames.active = Frames::counted(number));
        self.work_is(number, out);
    }

    /// Sets the work offset. `work` is the number of its code, or the number of the offset itself.
    fn work_is(&mut self, work: f64, out: &mut Out<'_>) {
        if self.place.work_is(work) {
            // an active cycle still returns to the initial level of the former work offset
            self.holes.series.initial_elsewhere |= self.holes.series.running;
            if self.settings.places_unknown {
                self.place.loses_frame();
            }
        }
        out.push(Action::Work(work));
    }
}
