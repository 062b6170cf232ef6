//! The state of a control, and a block's actions in the order in which a control does them.

use super::action::{Action, Cooling, Item, Position, Rotation};
use super::block::Block;
use super::codes::{GCode, Group, bit, g_code, letters};
use super::control::Control;
use super::cycles::Series;
use super::fault::{Done, refuse};
use super::frames::Frames;
use crate::diag::Code;
use crate::toolpath::{FeedMode, Plane, Side, StopKind, Units};

/// No motion: G80 of LinuxCNC.
pub(super) const NO_MOTION: u16 = 800;

/// What is run and how.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// By whose rules.
    pub control: Control,
    /// Units before the first G20 or G21.
    pub units: Units,
    /// Blocks with a slash are left out.
    pub block_delete: bool,
    /// How far G73 goes back, and how far above the last depth G83 ends its rapid, in the program's units; by default
    /// what the control does.
    pub back_off: Option<f64>,
    /// What a Fanuc makes of a length without a point.
    pub unpointed: Unpointed,
    /// Where the tool is counts as a place that only the machine knows at the beginning, and its height after a tool
    /// change; else it is at zero.
    pub places_unknown: bool,
    /// I, J and K are places from the beginning, as after G90.1.
    pub centers_absolute: bool,
    /// Which way G76 and G87 of a Fanuc move off the wall along the first axis: a parameter of the machine, 1 or -1.
    pub bore_shift: f64,
    /// Two things of a FADAL: a comment may go on to the end of its line without a mark, and E is the work offset.
    pub fadal: bool,
}

/// What a length without a point means on a Fanuc: a setting of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Unpointed {
    /// Nothing that could be known: an error.
    #[default]
    Refused,
    /// Whole inches or millimetres.
    Whole,
    /// Least increments: 0.0001 inch, 0.001 mm or degrees.
    Increments,
}

impl Settings {
    /// A control as it is switched on.
    pub fn new(control: Control) -> Settings {
        Settings {
            control,
            units: Units::Mm,
            block_delete: false,
            back_off: None,
            unpointed: Unpointed::Refused,
            places_unknown: false,
            centers_absolute: false,
            bore_shift: 1.0,
            fadal: false,
        }
    }
}

/// Words that are lengths or angles.
const LENGTHS: u32 = letters("XYZABCIJKRQ");

/// Where a program goes after a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// On to the next block.
    On,
    /// It is over.
    End,
    /// To a subprogram, so often.
    Call(f64, u32),
    /// Back from a subprogram.
    Return,
}

/// A control between two blocks.
#[derive(Debug)]
pub struct Machine {
    pub(super) settings: Settings,
    pub(super) control: Control,
    pub(super) position: Position,
    /// Axes that stand at a place in machine coordinates.
    pub(super) at_machine: u8,
    pub(super) frames: Frames,
    /// Modal motion code; [`NO_MOTION`] for none.
    pub(super) motion: u16,
    /// The cycle in force on a Fanuc.
    pub(super) cycle: Option<u16>,
    pub(super) series: Series,
    pub(super) plane: Plane,
    pub(super) units: Units,
    pub(super) absolute: bool,
    pub(super) centers_absolute: bool,
    pub(super) feed_mode: FeedMode,
    pub(super) feed: f64,
    pub(super) spindle: Rotation,
    pub(super) speed: f64,
    pub(super) compensated: bool,
    side: Option<Side>,
    /// D, which a Fanuc keeps.
    diameter_register: Option<f64>,
    /// A tool length offset is on.
    length_on: bool,
    /// G98: cycles return to the initial level.
    pub(super) to_initial: bool,
    pub(super) diameter: bool,
    homes: [Position; 2],
    tool: Option<f64>,
    /// What a machinist should know though the control does it, with the block.
    pub(super) warnings: Vec<(Code, &'static str)>,
}

/// Where actions go.
pub(super) struct Out<'a> {
    pub items: &'a mut Vec<Item>,
    pub line: u64,
    pub by_cycle: bool,
}

impl Out<'_> {
    #[inline]
    pub fn push(&mut self, action: Action) {
        self.items.push(Item { line: self.line, by_cycle: self.by_cycle, action });
    }
}

impl Machine {
    /// As switched on.
    pub fn new(settings: Settings) -> Machine {
        Machine {
            settings,
            control: settings.control,
            position: [0.0; 6],
            at_machine: if settings.places_unknown { 0b111 } else { 0 },
            frames: Frames::default(),
            motion: NO_MOTION,
            cycle: None,
            series: Series::default(),
            plane: Plane::Xy,
            units: settings.units,
            absolute: true,
            centers_absolute: settings.centers_absolute,
            feed_mode: FeedMode::PerMinute,
            feed: 0.0,
            spindle: Rotation::Stop,
            speed: 0.0,
            compensated: false,
            side: None,
            diameter_register: None,
            length_on: false,
            to_initial: !settings.control.is_linuxcnc(),
            diameter: false,
            homes: [[0.0; 6]; 2],
            tool: None,
            warnings: Vec::new(),
        }
    }

    /// Units before the first G20 or G21.
    pub(super) fn begin_in(&mut self, units: Units) {
        self.units = units;
    }

    /// Where the tool is.
    pub fn position(&self) -> &Position {
        &self.position
    }

    /// Axes that stand at a place in machine coordinates, as bits.
    #[inline]
    pub fn at_machine(&self) -> u8 {
        self.at_machine
    }

    /// Is a tool length offset on?
    pub(super) fn length_on(&self) -> bool {
        self.length_on
    }

    /// The units in force.
    pub fn units(&self) -> Units {
        self.units
    }

    /// The canned cycle in force, times ten.
    pub fn cycle_in_force(&self) -> Option<u16> {
        match self.control {
            Control::Fanuc => self.cycle,
            _ => Some(self.motion).filter(|&code| is_cycle(code)),
        }
    }

    /// Warnings since the last call.
    pub fn take_warnings(&mut self) -> Vec<(Code, &'static str)> {
        std::mem::take(&mut self.warnings)
    }

    /// Runs a block.
    ///
    /// # Errors
    /// What the control refuses.
    pub fn run(&mut self, block: &mut Block, line: u64, items: &mut Vec<Item>) -> Done<Next> {
        if !self.control.is_linuxcnc() && block.whole & LENGTHS != 0 {
            self.unpointed(block)?;
        }
        let motion = self.motion_of(block)?;
        let in_force = if self.control.is_linuxcnc() { None } else { self.cycle };
        let row = in_force.or(motion).and_then(|code| g_code(self.control, code));
        block.check_words(row, self.control)?;
        let mut out = Out { items, line, by_cycle: false };
        if let Some((start, end)) = block.comment {
            out.push(Action::Comment(start, end));
        }
        // most blocks only move
        if block.g(Group::FeedMode).is_some() {
            self.feed_mode(block, &mut out);
        }
        if let Some(feed) = block.get(b'F')
            && (self.feed_mode != FeedMode::InverseTime || !self.control.is_linuxcnc())
        {
            self.feed = feed;
        }
        let set_up = block.has(letters("ESTHD")) || !block.m().is_empty();
        if set_up || block.has_modes() {
            self.set_up(block, motion, &mut out)?;
        }
        if block.g(Group::Once) == Some(530) && (!matches!(motion, Some(0 | 10)) || in_force.is_some()) {
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
        if block.m().is_empty() { Ok(Next::On) } else { self.after(block, &mut out) }
    }

    /// Lengths without a point.
    fn unpointed(&self, block: &mut Block) -> Done {
        let inch = match block.g(Group::Units) {
            Some(code) => code == 200,
            None => self.units == Units::Inch,
        };
        if block.g(Group::Other).is_some() || block.m().contains(&19) {
            return Ok(()); // their words are no lengths
        }
        let cycle = block.g(Group::Cycle).or(self.cycle).is_some_and(|code| !matches!(code, NO_MOTION | 760 | 870));
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
            let cycle = block.g(Group::Cycle).is_some() || self.cycle.is_some();
            let circle = !cycle && matches!(self.motion, 20 | 30) && block.has(letters("IJK"));
            let runs = !self.control.is_linuxcnc() && (circle || cycle && block.has(bit(b'R')));
            return Ok(runs.then_some(self.motion));
        }
        if let Some(code) = word.filter(|&code| code != NO_MOTION) {
            if block.has_axes() && block.axes_are_taken() && self.control.is_linuxcnc() {
                let help = "write them in two blocks";
                return refuse(Code::PN004, "two codes that both use the axis words", help);
            }
            let needs_axes = is_cycle(code) || matches!(code, 330 | 760);
            if needs_axes && !block.has_axes() {
                return refuse(Code::PN006, "the code needs axis words and has none", "write where, as X and Y");
            }
            return Ok(Some(code));
        }
        if !self.control.is_linuxcnc() {
            let in_cycle = match block.g(Group::Cycle) {
                Some(code) => code != NO_MOTION,
                None => self.cycle.is_some(),
            };
            if self.motion == NO_MOTION && !in_cycle {
                return no_motion("no G0 or G1 says how to go there");
            }
            return Ok(Some(self.motion));
        }
        match word {
            Some(_) if moves => no_motion("axis words with G80"),
            Some(code) => Ok(Some(code)),
            None if self.motion == NO_MOTION => no_motion("no motion code is in force"),
            None => Ok(Some(self.motion)),
        }
    }

    fn feed_mode(&mut self, block: &Block, out: &mut Out<'_>) {
        let mode = match block.g(Group::FeedMode) {
            Some(930) => FeedMode::InverseTime,
            Some(950) => FeedMode::PerRev,
            _ => FeedMode::PerMinute,
        };
        // LinuxCNC forgets F at every such word, a Fanuc where the mode changes
        if mode != FeedMode::InverseTime && (self.control.is_linuxcnc() || mode != self.feed_mode) {
            self.feed = 0.0;
        }
        if mode != self.feed_mode {
            self.feed_mode = mode;
            out.push(Action::FeedMode(mode));
        }
    }

    /// Everything between feed and motion.
    fn set_up(&mut self, block: &Block, motion: Option<u16>, out: &mut Out<'_>) -> Done {
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

    fn spindle_and_tool(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
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
        match block.g(Group::SpindleMode) {
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
                19 => out.push(Action::Orient(block.get(b'R').unwrap_or(0.0))),
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

    fn turn_spindle(&mut self, code: u16, out: &mut Out<'_>) {
        self.spindle = match code {
            3 => Rotation::Cw,
            4 => Rotation::Ccw,
            _ => Rotation::Stop,
        };
        out.push(Action::Spindle(self.spindle, self.speed));
    }

    /// M6: the spindle stands afterwards.
    fn change_tool(&mut self, out: &mut Out<'_>) -> Done {
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

    fn set_units(&mut self, units: Units, feed: Option<f64>, out: &mut Out<'_>) {
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

    fn compensation(&mut self, block: &Block, motion: Option<u16>, out: &mut Out<'_>) -> Done {
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

    fn length(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let code = match block.g(Group::Length) {
            Some(code) => code,
            // a Fanuc changes the offset in force by H alone, a FADAL turns it on
            None => {
                if let Some(register) = block.get(b'H').filter(|_| !self.control.is_linuxcnc()) {
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
                // no table of tools tells its length: it counts as zero; G44 takes it off instead
                let register = register.unwrap_or(0.0);
                out.push(Action::Length(Some(if code == 440 { -register } else { register })));
            }
        }
        self.position = self.frames.to_program(&place);
        Ok(())
    }

    fn work_offset(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let Some(code) = block.g(Group::Work) else {
            if let Some(fixture) = block.get(b'E').filter(|_| self.settings.fadal) {
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

    /// Codes that hold for their block: G10, G28, G30, G52, G92.
    fn once(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        match block.g(Group::Once) {
            Some(100) => self.set_data(block, out),
            Some(code @ (280 | 300)) => self.go_home(usize::from(code == 300), block, out),
            Some(code @ (281 | 301)) => {
                self.homes[usize::from(code == 301)] = self.frames.to_machine(&self.position);
                Ok(())
            }
            Some(520 | 920..=923) => self.shift_frame(block, out),
            _ => Ok(()),
        }
    }

    fn set_data(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let l = block.get(b'L').unwrap_or(-1.0);
        if !self.control.is_linuxcnc() && l != 2.0 && l != 20.0 {
            // tool registers; no position depends on them here
            out.push(Action::LeftOut(b'G', 100));
            return Ok(());
        }
        if self.control.is_linuxcnc() && [1.0, 10.0, 11.0].contains(&l) {
            return refuse(Code::PN016, "G10 on the tool table is not simulated", "set the tool table at the machine");
        }
        let Some(p) = block.get(b'P').filter(|p| p.fract() == 0.0 && *p >= 0.0) else {
            return refuse(Code::PN007, "G10 without the number of its offset", "write P1 for G54");
        };
        if l != 2.0 && l != 20.0 {
            return refuse(Code::PN016, format!("G10 L{l} is not simulated"), "offsets are set by G10 L2 and L20");
        }
        let active = self.frames.active;
        let number = match (p as usize, self.control.is_linuxcnc()) {
            (0, true) => active,
            // an additional offset of a Haas or Fanuc
            (p, false) if l == 20.0 => p + 9,
            (p, _) => p,
        };
        let place = self.frames.to_machine(&self.position);
        let words: [Option<f64>; 6] = std::array::from_fn(|axis| self.axis_word(block, axis));
        let (absolute, control, position) = (self.absolute, self.control, self.position);
        let Some((work, rotation)) = self.frames.work(number) else {
            return refuse(Code::PN018, format!("there is no work offset P{p}"), "write P1 for G54");
        };
        let before = [*work, [*rotation; 6]];
        for (axis, value) in words.iter().enumerate() {
            let Some(value) = *value else { continue };
            work[axis] = match l == 20.0 && control.is_linuxcnc() {
                // so that the tool stands at the value
                true => work[axis] + position[axis] - value,
                false if absolute || control.is_linuxcnc() => value,
                false => work[axis] + value,
            };
        }
        if let Some(angle) = block.get(b'R') {
            *rotation = angle;
        }
        let changed = [*work, [*rotation; 6]] != before;
        self.position = self.frames.to_program(&place);
        out.push(if changed { Action::Frame } else { Action::LeftOut(b'G', 100) });
        Ok(())
    }

    fn shift_frame(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let place = self.frames.to_machine(&self.position);
        let before = self.frames.shift;
        match block.g(Group::Once) {
            Some(921) => (self.frames.shift, self.frames.shift_kept) = ([0.0; 6], [0.0; 6]),
            Some(922) => self.frames.shift = [0.0; 6],
            Some(923) => self.frames.shift = self.frames.shift_kept,
            code => {
                if !block.has_axes() {
                    return refuse(Code::PN006, "the code needs axis words and has none", "write the axes it shifts");
                }
                for axis in 0..6 {
                    let Some(value) = self.axis_word(block, axis) else { continue };
                    self.frames.shift[axis] =
                        if code == Some(520) { value } else { self.frames.shift[axis] + self.position[axis] - value };
                }
            }
        }
        if matches!(block.g(Group::Once), Some(520 | 920)) {
            self.frames.shift_kept = self.frames.shift;
        }
        self.position = self.frames.to_program(&place);
        if self.frames.shift != before {
            out.push(Action::Frame);
        }
        Ok(())
    }

    /// By way of a place to the reference point.
    fn go_home(&mut self, which: usize, block: &Block, out: &mut Out<'_>) -> Done {
        if self.compensated {
            return refuse(Code::PN013, "G28 or G30 under cutter compensation", "end the compensation with G40 first");
        }
        let named: u8 = (0..6).filter(|&axis| self.axis_word(block, axis).is_some()).map(|axis| 1 << axis).sum();
        if named == 0 && !self.control.is_linuxcnc() {
            return refuse(Code::PN006, "G28 or G30 without axes", "write the axes that go home, as G91 G28 Z0");
        }
        let axes = if named == 0 { 0x3f } else { named };
        let way = self.target(block)?;
        self.rapid_to(way, out);
        let home = self.frames.to_program(&self.homes[which]);
        let mut to = self.position;
        for axis in (0..6).filter(|axis| axes & 1 << axis != 0) {
            to[axis] = home[axis];
        }
        // an axis at angle zero is at its reference point
        self.at_machine |= axes & 0b111;
        self.position = to;
        out.push(Action::Rapid { to, machine: self.at_machine });
        Ok(())
    }

    fn move_by(&mut self, code: u16, row: Option<&'static GCode>, block: &Block, out: &mut Out<'_>) -> Done {
        let moved = match code {
            0 | 10 => self.straight(code, block, out),
            20 | 30 => self.arc(code, block, out),
            330 => self.synchronised(block, out),
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
                self.leave_cycle(self.motion, out);
            } else {
                self.enter_fanuc_cycle(code);
            }
        }
        if let Some(code) = block.g(Group::Motion) {
            self.leave_cycle(code, out);
        }
        if let (Some(code), true) = (self.cycle, motion.is_some() || block.g(Group::Cycle).is_some()) {
            return self.fanuc_cycle(code, block, out);
        }
        match motion {
            Some(_) if !block.has_axes() && !block.has(letters("IJKR")) => Ok(()),
            Some(code @ (0 | 10)) => self.straight(code, block, out),
            Some(code @ (20 | 30)) => self.arc(code, block, out),
            _ => Ok(()),
        }
    }

    /// A motion that is no cycle: the series is over.
    fn leave_cycle(&mut self, code: u16, out: &mut Out<'_>) {
        if self.cycle_in_force().is_some() {
            out.push(Action::CycleOff);
        }
        self.motion = code;
        self.cycle = None;
        self.series.end();
    }

    /// Stops and subprograms come last.
    fn after(&mut self, block: &Block, out: &mut Out<'_>) -> Done<Next> {
        let mut next = Next::On;
        for &code in block.m() {
            match code {
                5 if !self.control.is_linuxcnc() => self.turn_spindle(5, out),
                9 if !self.control.is_linuxcnc() => out.push(Action::Coolant(Cooling::Off)),
                0 | 60 => out.push(Action::Stop(StopKind::Program)),
                1 => out.push(Action::Stop(StopKind::Optional)),
                2 | 30 => {
                    out.push(Action::End);
                    next = Next::End;
                }
                97 if !self.control.is_linuxcnc() => {
                    let help = "write the subprogram with an O number, and M98";
                    return refuse(Code::PN016, "M97, a call of blocks by their number, is not simulated", help);
                }
                98 => next = self.call(block)?,
                99 if block.has(bit(b'P')) => {
                    let help = "return to the block behind the call";
                    return refuse(Code::PN016, "M99 P, a jump, is not simulated", help);
                }
                99 => next = Next::Return,
                _ => {}
            }
        }
        Ok(next)
    }

    /// M98 P1000 L3, or P31000 as older controls have it.
    fn call(&self, block: &Block) -> Done<Next> {
        let Some(p) = block.get(b'P').filter(|p| p.fract() == 0.0 && *p >= 1.0) else {
            return refuse(Code::PN007, "M98 without the number of its subprogram", "write P and the number");
        };
        let times = block.get(b'L').unwrap_or(1.0);
        if times.fract() != 0.0 || !(0.0..=9999.0).contains(&times) {
            return refuse(Code::PN018, format!("L{times} is no number of calls"), "write L1 to L9999");
        }
        if p > 9999.0 && block.get(b'L').is_none() && !self.control.is_linuxcnc() {
            return Ok(Next::Call(p % 10_000.0, (p / 10_000.0) as u32));
        }
        Ok(Next::Call(p, times as u32))
    }
}

fn no_motion<T>(message: &str) -> Done<T> {
    refuse(Code::PN006, message, "write G0, G1 or the cycle's code in this block")
}

/// Is it a canned cycle of LinuxCNC?
pub(super) fn is_cycle(code: u16) -> bool {
    matches!(code, 730 | 740 | 810..=890)
}
