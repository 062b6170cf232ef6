//! What a block says before it moves: feed mode, spindle, tool, dwell, plane, units, compensation, length, work offset.

use super::action::{Action, Cooling, Rotation};
use super::block::Block;
use super::codes::{Group, bit, letters};
use super::fault::{Done, refuse};
use super::machine::{Machine, Out};
use crate::control::Rules;
use crate::diag::Code;
use crate::toolpath::{FeedMode, Plane, Side, Units};

impl Machine {
    pub(super) fn feed_mode(&mut self, block: &Block, out: &mut Out<'_>) {
        let mode = match block.g(Group::FeedMode) {
            Some(930) => FeedMode::InverseTime,
            Some(950) => FeedMode::PerRev,
            _ => FeedMode::PerMinute,
        };
        // LinuxCNC forgets F at every such word, others where the mode changes
        if mode != FeedMode::InverseTime && (self.forgets_feed() || mode != self.feed_mode) {
            self.feed = 0.0;
        }
        if mode != self.feed_mode {
            self.feed_mode = mode;
            out.push(Action::FeedMode(mode));
        }
    }

    fn forgets_feed(&self) -> bool {
        matches!(self.control.rules(), Rules::Linuxcnc | Rules::Emc2)
    }

    /// Everything between feed and motion.
    pub(super) fn set_up(&mut self, block: &Block, motion: Option<u16>, out: &mut Out<'_>) -> Done {
        self.spindle_and_tool(block, out)?;
        if block.g(Group::Once) == Some(40) {
            let x_is_no_time = block.has(bit(b'X')) && block.has(bit(b'P'));
            if !self.control.is_linuxcnc() && (block.has(letters("YZABC")) || x_is_no_time) {
                let help = "write the dwell in a block of its own: X is its time, too";
                return refuse(Code::PN004, "G4 and axis words in one block", help);
            }
            let seconds = match (block.get(b'P'), block.get(b'X')) {
                (Some(p), _) => self.seconds(p, block),
                (None, Some(x)) if !self.control.is_linuxcnc() => x,
                _ => return refuse(Code::PN007, "G4 without its time", "write G4 P1. for a second"),
            };
            if seconds < 0.0 {
                return refuse(Code::PN018, "a negative dwell", "write P without the minus");
            }
            out.push(Action::Dwell(seconds));
        }
        let plane = match block.g(Group::Plane) {
            Some(180) => Plane::Xz,
            Some(190) => Plane::Yz,
            Some(_) => Plane::Xy,
            None => self.plane,
        };
        if plane != self.plane {
            self.plane = plane;
            out.push(Action::Plane(plane));
        }
        let feed = block.get(b'F').filter(|_| !self.control.is_linuxcnc());
        match block.g(Group::Units) {
            Some(200) => self.set_units(Units::Inch, feed, out),
            Some(210) => self.set_units(Units::Mm, feed, out),
            _ => {}
        }
        match block.g(Group::Diameter) {
            Some(70) => self.diameter = true,
            Some(80) => self.diameter = false,
            _ => {}
        }
        self.compensation(block, motion, out)?;
        self.length(block, out)?;
        self.work_offset(block, out)?;
        if let Some(code) = block.g(Group::Distance) {
            self.absolute = code == 900;
        }
        if let Some(code) = block.g(Group::ArcDistance) {
            self.centers_absolute = code == 901;
        }
        if let Some(code) = block.g(Group::Return) {
            if self.compensated && self.control.is_linuxcnc() {
                return refuse(
                    Code::PN013,
                    "G98 or G99 under cutter compensation",
                    "end the compensation with G40 first",
                );
            }
            self.to_initial = code == 980;
        }
        Ok(())
    }

    pub(super) fn spindle_and_tool(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let speed = block.get(b'S');
        if let Some(speed) = speed {
            if speed < 0.0 {
                return refuse(
                    Code::PN018,
                    "a negative S",
                    "write the speed without the minus, the direction as M3 or M4",
                );
            }
            self.speed = speed;
        }
        match block.g(Group::SpeedMode) {
            Some(960) => out.push(Action::SurfaceSpeed(Some(block.get(b'D').unwrap_or(0.0)))),
            Some(970) => out.push(Action::SurfaceSpeed(None)),
            _ => {}
        }
        if let Some(tool) = block.get(b'T') {
            if tool < 0.0 || tool.fract() != 0.0 {
                return refuse(Code::PN018, format!("T{tool} is no tool"), "tools are whole numbers");
            }
            self.tool = Some(tool);
        }
        if block.m().contains(&6) {
            self.change_tool(out)?;
        }
        let mut turned = false;
        for &code in block.m() {
            match code {
                // a Fanuc stops spindle and coolant when the block's motion is done
                5 | 9 if !self.control.is_linuxcnc() => turned |= code == 5,
                3..=5 => {
                    turned = true;
                    self.turn_spindle(code, out);
                }
                19 => {
                    self.spindle = Rotation::Stop; // it stands at its angle
                    out.push(Action::Orient(block.get(b'R').unwrap_or(0.0)));
                }
                7 => out.push(Action::Coolant(Cooling::Mist)),
                8 => out.push(Action::Coolant(Cooling::Flood)),
                9 => out.push(Action::Coolant(Cooling::Off)),
                0..=2 | 6 | 30 | 60 | 98 | 99 => {}
                _ => out.push(Action::LeftOut(b'M', code * 10)),
            }
        }
        for group in [Group::Path, Group::Once] {
            if let Some(code) = block.g(group).filter(|&code| group == Group::Path || code == 90) {
                out.push(Action::LeftOut(b'G', code));
            }
        }
        if let Some(code) = block.g(Group::Other) {
            out.push(Action::LeftOut(b'G', code));
        }
        if speed.is_some() && !turned {
            out.push(Action::Spindle(self.spindle, self.speed));
        }
        Ok(())
    }

    pub(super) fn turn_spindle(&mut self, code: u16, out: &mut Out<'_>) {
        self.spindle = match code {
            3 => Rotation::Cw,
            4 => Rotation::Ccw,
            _ => Rotation::Stop,
        };
        out.push(Action::Spindle(self.spindle, self.speed));
    }

    /// M6: the spindle stands afterwards.
    pub(super) fn change_tool(&mut self, out: &mut Out<'_>) -> Done {
        let Some(tool) = self.tool else {
            return refuse(Code::PN007, "M6 without a tool", "write T and the tool's number before it");
        };
        if self.settings.places_unknown {
            self.at_machine |= 0b100;
        }
        self.spindle = Rotation::Stop;
        out.push(Action::Tool(tool));
        Ok(())
    }

    /// P in seconds: on a Fanuc milliseconds when it has no point.
    pub(super) fn seconds(&self, p: f64, block: &Block) -> f64 {
        if !self.control.is_linuxcnc() && block.whole & bit(b'P') != 0 { p / 1000.0 } else { p }
    }

    pub(super) fn set_units(&mut self, units: Units, feed: Option<f64>, out: &mut Out<'_>) {
        if units != self.units {
            let factor = if units == Units::Inch { 1.0 / 25.4 } else { 25.4 };
            self.units = units;
            self.position[..3].iter_mut().for_each(|v| *v *= factor);
            self.frames.scale(factor);
            self.homes.iter_mut().for_each(|home| home[..3].iter_mut().for_each(|v| *v *= factor));
            if self.feed_mode != FeedMode::InverseTime {
                self.feed *= factor;
            }
            // LinuxCNC takes F before the units of its block, a Fanuc after them
            if let Some(feed) = feed {
                self.feed = feed;
            }
        }
        out.push(Action::Units(units));
    }

    pub(super) fn compensation(&mut self, block: &Block, motion: Option<u16>, out: &mut Out<'_>) -> Done {
        if !self.control.is_linuxcnc() {
            self.diameter_register = block.get(b'D').or(self.diameter_register);
        }
        let Some(code) = block.g(Group::Compensation) else {
            // another register while it is on
            if let (Some(side), Some(_), false) = (self.side, block.get(b'D'), self.control.is_linuxcnc()) {
                out.push(Action::Compensation(Some((side, self.diameter_register))));
            }
            return Ok(());
        };
        if code == 400 {
            self.compensated = false;
            self.side = None;
            out.push(Action::Compensation(None));
            return Ok(());
        }
        if self.compensated && self.control.is_linuxcnc() {
            return refuse(Code::PN013, "cutter compensation is on already", "end it with G40 first");
        }
        if !self.control.is_linuxcnc() && matches!(motion, Some(20 | 30)) {
            return refuse(Code::PN013, "cutter compensation begins on an arc", "begin it on a straight move");
        }
        self.compensated = true;
        let side = if matches!(code, 410 | 411) { Side::Left } else { Side::Right };
        // LinuxCNC takes the tool's own diameter where no register is named
        let register = match code {
            411 | 421 => None, // a diameter, and no register
            _ if self.control.is_linuxcnc() => block.get(b'D').or(self.tool),
            _ => self.diameter_register,
        };
        if register.is_none() && !self.control.is_linuxcnc() {
            let help = "write D with the tool's register: G41 D1";
            return refuse(Code::PN007, "cutter compensation without D", help);
        }
        self.side = Some(side);
        out.push(Action::Compensation(Some((side, register))));
        Ok(())
    }

    pub(super) fn length(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let code = match block.g(Group::Length) {
            Some(code) => code,
            // a Fanuc changes the offset in force by H alone, a FADAL turns it on
            None => {
                let counts = self.length_on || self.control.traits().height_is_machine;
                if let Some(register) = block.get(b'H').filter(|_| counts && !self.control.is_linuxcnc()) {
                    self.length_on = true;
                    out.push(Action::Length(Some(register)));
                }
                return Ok(());
            }
        };
        let place = self.frames.to_machine(&self.position);
        self.length_on = code != 490;
        match code {
            490 => {
                self.frames.tool = [0.0; 3];
                out.push(Action::Length(None));
            }
            431 => {
                for (axis, letter) in (*b"XYZ").into_iter().enumerate() {
                    if let Some(value) = block.get(letter) {
                        self.frames.tool[axis] = value;
                    }
                }
                out.push(Action::Length(Some(0.0)));
            }
            _ => {
                let register = block.get(b'H').or(self.tool);
                if block.get(b'H').is_none() && !self.control.is_linuxcnc() {
                    let help = "write H with the tool's register: G43 H1";
                    return refuse(Code::PN007, "a tool length offset without H", help);
                }
                if code == 432 && block.get(b'H').is_none() {
                    return refuse(Code::PN007, "G43.2 without H", "write H with the tool's number");
                }
                if code != 432 {
                    self.frames.tool = [0.0; 3]; // what G43.1 set is gone
                }
                // no table of tools tells its length: it counts as zero; G44 takes it off instead
                let register = register.unwrap_or(0.0);
                out.push(Action::Length(Some(if code == 440 { -register } else { register })));
            }
        }
        self.position = self.frames.to_program(&place);
        Ok(())
    }

    pub(super) fn work_offset(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let Some(code) = block.g(Group::Work) else {
            if let Some(fixture) = self.control.traits().work_letter.and_then(|letter| block.get(letter)) {
                out.push(Action::Work(fixture));
            }
            return Ok(());
        };
        let (number, name) = match (code, block.get(b'P')) {
            (541 | 1540, Some(p)) if (1.0..=99.0).contains(&p) && p.fract() == 0.0 => (9 + p as usize, 1540.0 + p),
            (541 | 1540, _) => {
                return refuse(Code::PN007, "an additional work offset without its number", "write P1 to P99 with it");
            }
            (591..=593, _) => (usize::from(code - 591) + 7, f64::from(code) / 10.0),
            _ => (usize::from(code / 10 - 53), f64::from(code) / 10.0),
        };
        let place = self.frames.to_machine(&self.position);
        self.frames.active = number;
        self.position = self.frames.to_program(&place);
        out.push(Action::Work(name));
        Ok(())
    }
}
