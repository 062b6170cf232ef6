//! The state of a control, and a block's actions in the order in which a control does them.

use super::action::{Action, Cooling, Item, Position, Rotation};
use super::block::Block;
use super::codes::{Group, bit, g_code, letters};
use super::cycles::{Series, Work};
use super::fault::{Done, refuse};
use super::frames::Frames;
use crate::control::{Control, Row, Rules};
use crate::diag::Code;
use crate::toolpath::{FeedMode, Plane, Side, StopKind, Units};

/// No motion: G80 of LinuxCNC.
pub(super) const NO_MOTION: u16 = 800;

/// What is run and how.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// By whose rules.
    pub control: &'static Control,
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
    pub fn new(control: &'static Control) -> Settings {
        Settings {
            control,
            units: Units::Mm,
            block_delete: false,
            back_off: None,
            unpointed: Unpointed::Refused,
            places_unknown: false,
            centers_absolute: false,
            bore_shift: 1.0,
        }
    }
}

/// Words that are lengths or angles.
const LENGTHS: u32 = letters("XYZABCIJKRQ");

/// Actions after which the rest of a block waits for the next call.
const AT_ONCE: usize = 4096;

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
    /// The block is not done: [`Machine::run_on`].
    Rest,
}

/// A control between two blocks.
#[derive(Debug)]
pub struct Machine {
    pub(super) settings: Settings,
    pub(super) control: &'static Control,
    pub(super) position: Position,
    /// Axes that stand at a place in machine coordinates.
    pub(super) at_machine: u8,
    pub(super) frames: Frames,
    /// Modal motion code; [`NO_MOTION`] for none.
    pub(super) motion: u16,
    /// The cycle in force on a Fanuc.
    pub(super) cycle: Option<u16>,
    pub(super) series: Series,
    /// What the block's cycle still has to make.
    pub(super) work: Option<Work>,
    pub(super) plane: Plane,
    pub(super) units: Units,
    pub(super) absolute: bool,
    pub(super) centers_absolute: bool,
    pub(super) feed_mode: FeedMode,
    pub(super) feed: f64,
    pub(super) spindle: Rotation,
    pub(super) speed: f64,
    pub(super) compensated: bool,
    pub(super) side: Option<Side>,
    /// D, which a Fanuc keeps.
    pub(super) diameter_register: Option<f64>,
    /// A tool length offset is on.
    pub(super) length_on: bool,
    /// G98: cycles return to the initial level.
    pub(super) to_initial: bool,
    pub(super) diameter: bool,
    pub(super) homes: [Position; 2],
    pub(super) tool: Option<f64>,
    /// What a machinist should know though the control does it, with the block.
    pub(super) warnings: Vec<(Code, &'static str)>,
}

/// Where actions go.
pub(super) struct Out<'a> {
    pub items: &'a mut Vec<Item>,
    /// How many there were.
    start: usize,
    pub line: u64,
    pub by_cycle: bool,
}

impl<'a> Out<'a> {
    /// Behind what is there.
    fn new(items: &'a mut Vec<Item>, line: u64) -> Out<'a> {
        Out { start: items.len(), items, line, by_cycle: false }
    }

    /// Is there enough to be read?
    #[inline]
    pub fn is_full(&self) -> bool {
        self.items.len() - self.start >= AT_ONCE
    }

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
            motion: if settings.control.rules() == Rules::Grbl { 0 } else { NO_MOTION },
            cycle: None,
            series: Series::default(),
            work: None,
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

    /// A place of the program in machine coordinates, in the units in force.
    pub fn in_machine_coordinates(&self, at: &Position) -> Position {
        self.frames.to_machine(at)
    }

    /// The units in force.
    pub fn units(&self) -> Units {
        self.units
    }

    /// The canned cycle in force, times ten.
    pub fn cycle_in_force(&self) -> Option<u16> {
        match self.control.rules() {
            Rules::Fanuc => self.cycle,
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
        if self.control.rules() == Rules::Grbl {
            let before = items.len();
            let done = self.grbl_block(block, &mut Out::new(items, line));
            if done.is_err() {
                items.truncate(before);
            }
            return done;
        }
        if !self.control.is_linuxcnc() && block.whole & LENGTHS != 0 {
            self.unpointed(block)?;
        }
        let motion = self.motion_of(block)?;
        let in_force = if self.control.is_linuxcnc() { None } else { self.cycle };
        let row = in_force.or(motion).and_then(|code| g_code(self.control, code));
        block.check_words(row, self.control)?;
        let mut out = Out::new(items, line);
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
        if self.work.is_some() {
            return Ok(Next::Rest);
        }
        if block.m().is_empty() { Ok(Next::On) } else { self.after(block, out) }
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
            let needs_axes = is_cycle(code) || matches!(code, 330 | 331 | 760);
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
