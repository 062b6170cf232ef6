//! A small machine. It runs a milling program block by block and records its acts. Lengths are in millimetres.

mod curves;

use std::collections::HashMap;

use super::modes::{Family, is_cycle, is_harmless};
use super::scan::{Word, words};
use super::{INCH, Place};
pub(super) use curves::by_radius;

/// The state during an act.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct State {
    /// The tool in the spindle.
    pub tool: f64,
    /// The active length register.
    pub length: Option<f64>,
    /// Work offset: 54, 154.2, or the E of a Fadal.
    pub work: f64,
    /// Spindle direction: 3, 4 or 5.
    pub direction: f64,
    /// Spindle speed in revolutions per minute.
    pub speed: f64,
    /// Coolant: 1 is mist, 2 is flood, 3 is both.
    pub coolant: u8,
    /// Compensation: 40, 41 or 42, and its register.
    pub side: (f64, f64),
    /// Feed in millimetres, and its mode: 93, 94 or 95.
    pub feed: (f64, f64),
}

/// The kind of an act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum What {
    /// A rapid.
    Rapid,
    /// A straight cut.
    Feed,
    /// An arc: its plane, its centre in the plane, whether it turns counter-clockwise, and the number of additional
    /// full turns.
    Arc { plane: f64, center: [f64; 2], ccw: bool, turns: f64 },
    /// A pass of a thread, with its lead.
    Thread(f64),
    /// A canned cycle: code, R and Z, height at the end, Q and P, and jog.
    Hole { code: f64, r: f64, z: f64, out: f64, q: f64, p: f64, jog: [f64; 2] },
    /// A dwell in seconds.
    Dwell(f64),
    /// M0, M1.
    Stop(f64),
    /// The spindle is oriented to an angle.
    Orient(f64),
    /// A tool change.
    Tool,
    /// The end of the program.
    End,
}

/// An act: its kind, its position and the state.
#[derive(Clone, Copy, Debug)]
pub struct Act {
    /// The program's line, from 1.
    pub line: usize,
    /// The kind of the act.
    pub what: What,
    /// Start position.
    pub from: Place,
    /// End position.
    pub to: Place,
    /// The state during the act.
    pub state: State,
}

impl Act {
    /// Whether the act is a cut.
    pub fn cuts(&self) -> bool {
        match self.what {
            What::Feed => !super::same(&self.from, &self.to, 1e-6),
            What::Hole { r, z, .. } => (r - z).abs() > 1e-6,
            What::Arc { .. } | What::Thread(_) => true,
            _ => false,
        }
    }

    /// Whether the act is a move straight up or down.
    pub fn plunges(&self) -> bool {
        (0..6).all(|axis| axis == 2 || super::near(self.from[axis], self.to[axis], 1e-9))
    }
}

/// The program number of every job; subprograms have other numbers.
pub const MAIN: u32 = 7;

/// Runs a program.
///
/// # Errors
/// The line at which the machine stops, and the reason: an unknown code, or words that make no sense.
pub fn run(program: &str, control: &str, inch: bool) -> Result<Vec<Act>, (usize, String)> {
    let lines: Vec<&str> = program.lines().collect();
    let mut machine = Machine::new(control, inch);
    let mut labels = HashMap::new();
    for (number, line) in lines.iter().enumerate() {
        if let Ok([(b'O', label), ..]) = words(line).as_deref() {
            labels.insert(label.to_bits(), number);
        }
    }
    let mut stack: Vec<(usize, usize, u32)> = Vec::new();
    // a form without O words has no subprograms
    let mut at = labels.get(&f64::from(MAIN).to_bits()).map_or(0, |line| line + 1);
    let mut steps = 0;
    while at < lines.len() {
        steps += 1;
        if steps > 100_000 {
            return Err((at + 1, "no end".into()));
        }
        let list = words(lines[at]).map_err(|error| (at + 1, error))?;
        let next = machine.block(&list, at + 1).map_err(|error| (at + 1, error))?;
        at += 1;
        match next {
            Next::On => {}
            Next::End => return Ok(machine.acts),
            Next::Call(label, times) => {
                let target = *labels.get(&label.to_bits()).ok_or((at, format!("no O{label}")))?;
                if times > 0 && stack.len() < 10 {
                    stack.push((at, target, times - 1));
                    at = target + 1;
                }
            }
            Next::Return => match stack.pop() {
                None => return Ok(machine.acts),
                Some((back, _, 0)) => at = back,
                Some((back, target, left)) => {
                    stack.push((back, target, left - 1));
                    at = target + 1;
                }
            },
        }
    }
    Err((lines.len(), "the program has no end".into()))
}

enum Next {
    On,
    End,
    Call(f64, u32),
    Return,
}

struct Cycle {
    code: f64,
    r: Option<f64>,
    z: Option<f64>,
    q: f64,
    p: f64,
    jog: [f64; 2],
    initial: f64,
    /// For a tap on a Brother: I in millimetres, J in threads per inch.
    pitch: Option<f64>,
}

struct Machine {
    control: String,
    family: Family,
    scale: f64,
    at: Place,
    state: State,
    motion: f64,
    /// The motion before a cycle, which G80 restores.
    motion_before: f64,
    absolute: bool,
    centres_absolute: bool,
    plane: f64,
    to_r: bool,
    next_tool: f64,
    /// The second T of the block.
    tool_after: Option<f64>,
    cycle: Option<Cycle>,
    /// The origin of the frame of G92 or G52.
    shift: [f64; 3],
    acts: Vec<Act>,
}

/// The words of a block.
struct Block<'w>(&'w [Word]);

impl Block<'_> {
    fn get(&self, letter: u8) -> Option<f64> {
        self.0.iter().rfind(|(other, _)| *other == letter).map(|(_, number)| *number)
    }

    fn has(&self, letter: u8, number: f64) -> bool {
        self.0.contains(&(letter, number))
    }
}

impl Machine {
    fn new(control: &str, inch: bool) -> Machine {
        Machine {
            control: control.into(),
            family: Family::of(control),
            scale: if inch { INCH } else { 1.0 },
            at: [f64::NAN, f64::NAN, f64::NAN, 0.0, 0.0, 0.0],
            state: State { direction: 5.0, side: (40.0, 0.0), feed: (f64::NAN, 94.0), work: 54.0, ..State::default() },
            motion: f64::NAN,
            motion_before: 0.0,
            absolute: true,
            centres_absolute: false,
            plane: 17.0,
            to_r: false,
            next_tool: 0.0,
            tool_after: None,
            cycle: None,
            shift: [0.0; 3],
            acts: Vec::new(),
        }
    }

    /// G92 sets the coordinates of the current position. G52 sets the origin of the frame.
    fn frame(&mut self, block: &Block<'_>, is_here: bool) {
        for (axis, letter) in b"XYZ".iter().enumerate() {
            if let Some(number) = block.get(*letter) {
                let place = number * self.scale;
                self.shift[axis] = if is_here { self.at[axis] - place } else { place };
            }
        }
    }

    fn act(&mut self, line: usize, what: What, to: Place) {
        self.acts.push(Act { line, what, from: self.at, to, state: self.state });
        self.at = to;
    }

    fn block(&mut self, list: &[Word], line: usize) -> Result<Next, String> {
        let block = Block(list);
        let mut machine_place = false;
        let mut reference = false;
        let mut dwell = false;
        let mut rigid = false;
        let mut probes = false;
        let mut frame = None;
        let mut motion = None;
        for &(letter, number) in list {
            if letter == b'G' {
                match number {
                    0.0 | 1.0 | 2.0 | 3.0 => motion = Some(number),
                    33.1 if self.family == Family::Linuxcnc => rigid = true,
                    4.0 => dwell = true,
                    17.0 | 18.0 | 19.0 => self.plane = number,
                    20.0 => self.units(INCH),
                    21.0 => self.units(1.0),
                    28.0 | 30.0 => reference = true,
                    // down to the surface of the sheet, whose height is unknown
                    38.2 if self.family == Family::Linuxcnc => {
                        self.at[2] = f64::NAN;
                        probes = true;
                    }
                    92.1 if self.family == Family::Linuxcnc => self.shift = [0.0; 3],
                    40.0 => self.state.side = (40.0, 0.0),
                    41.0 | 42.0 => self.state.side = (number, block.get(b'D').unwrap_or(self.state.side.1)),
                    43.0 => self.length(Some(block.get(b'H').unwrap_or(self.state.tool))),
                    49.0 => self.length(None),
                    52.0 | 92.0 => frame = Some(number == 92.0),
                    53.0 => machine_place = true,
                    54.1 | 154.0 => self.work(59.0 + block.get(b'P').ok_or("an offset without P")?),
                    59.1 | 59.2 | 59.3 => self.work((number * 10.0).round() - 531.0),
                    54.0..60.0 => self.work(number),
                    80.0 => {
                        self.cycle = None;
                        self.motion = if self.family == Family::Linuxcnc { 80.0 } else { self.motion_before };
                    }
                    90.0 => self.absolute = true,
                    90.1 => self.centres_absolute = true,
                    91.0 => self.absolute = false,
                    93.0 | 94.0 | 95.0 => {
                        if self.state.feed.1 != number {
                            self.state.feed = (f64::NAN, number);
                        }
                    }
                    97.0 => {}
                    98.0 => self.to_r = false,
                    99.0 => self.to_r = true,
                    cycle if is_cycle(cycle) => motion = Some(cycle),
                    other if is_harmless(other) => {}
                    other => return Err(format!("G{other}")),
                }
            }
        }
        if list.iter().any(|&(letter, number)| letter == b'G' && number == 91.1) {
            self.centres_absolute = false;
        }
        self.letters(&block);
        let ends = self.codes(&block, line)?;
        if dwell {
            let seconds = block.get(b'P').ok_or("G4 without P")?;
            let seconds = self.family.dwell(&self.control, seconds);
            let at = self.at;
            self.act(line, What::Dwell(seconds), at);
        } else if let Some(is_here) = frame {
            self.frame(&block, is_here);
        } else if reference {
            self.reference(&block, line);
        } else if probes {
            if block.get(b'X').is_some() || block.get(b'Y').is_some() {
                return Err("a probe that goes across".into());
            }
        } else if rigid {
            self.rigid_tap(&block, line)?;
        } else {
            self.moves(&block, motion, machine_place, line)?;
        }
        // stops and ends are executed last
        for code in [0.0, 1.0] {
            if block.has(b'M', code) {
                let at = self.at;
                self.act(line, What::Stop(code), at);
            }
        }
        if ends {
            let at = self.at;
            self.act(line, What::End, at);
            return Ok(Next::End);
        }
        if block.has(b'M', 98.0) {
            return Ok(Next::Call(block.get(b'P').unwrap_or(0.0), block.get(b'L').unwrap_or(1.0) as u32));
        }
        Ok(if block.has(b'M', 99.0) { Next::Return } else { Next::On })
    }

    fn units(&mut self, scale: f64) {
        if self.scale != scale {
            self.state.feed.0 = f64::NAN;
        }
        self.scale = scale;
    }

    fn length(&mut self, register: Option<f64>) {
        if self.state.length != register {
            self.at[2] = f64::NAN;
        }
        self.state.length = register;
    }

    fn work(&mut self, number: f64) {
        if self.state.work != number {
            self.at[..3].fill(f64::NAN);
        }
        self.state.work = number;
    }

    /// Handles the F, S and T words, and the E and H words that select an offset without a G code.
    fn letters(&mut self, block: &Block<'_>) {
        if let Some(feed) = block.get(b'F') {
            let scale = if self.state.feed.1 == 93.0 { 1.0 } else { self.scale };
            self.state.feed.0 = feed * scale;
        }
        if let Some(speed) = block.get(b'S') {
            self.state.speed = speed;
        }
        let mut tools = block.0.iter().filter(|word| word.0 == b'T').map(|word| word.1);
        (self.next_tool, self.tool_after) = (tools.next().unwrap_or(self.next_tool), tools.next());
        // E of a Centroid selects a work offset
        if let Some(work) = block.get(b'E').filter(|_| self.control == "centroid") {
            self.work(work + 53.0);
        }
        if self.family == Family::Fadal {
            if let Some(work) = block.get(b'E') {
                self.work(work);
            }
            if let Some(length) = block.get(b'H').filter(|_| !block.has(b'G', 49.0)) {
                self.length(Some(length).filter(|length| *length != 0.0));
            }
        } else if let (Family::Fanuc, Some(_), Some(length)) = (self.family, self.state.length, block.get(b'H')) {
            self.length(Some(length));
        }
    }

    /// Handles M codes except stops. Returns true at the end of the program.
    fn codes(&mut self, block: &Block<'_>, line: usize) -> Result<bool, String> {
        let mut ends = false;
        for &(_, code) in block.0.iter().filter(|(letter, _)| *letter == b'M') {
            match code {
                0.0 | 1.0 | 29.0 | 48.0..=53.0 | 98.0 | 99.0 => {}
                2.0 | 30.0 => ends = true,
                3.0..=5.0 => self.state.direction = code,
                6.0 => {
                    self.state.tool = self.next_tool;
                    self.next_tool = self.tool_after.unwrap_or(self.next_tool);
                    let at = self.at;
                    self.act(line, What::Tool, at);
                    // the height at which the machine changes a tool is unknown
                    self.at[2] = f64::NAN;
                    self.state.direction = 5.0;
                }
                7.0 => self.state.coolant |= 1,
                8.0 => self.state.coolant |= 2,
                9.0 => self.state.coolant = 0,
                19.0 => {
                    let at = self.at;
                    let angle = block.get(b'R').unwrap_or(0.0);
                    self.state.direction = 5.0;
                    self.act(line, What::Orient(angle), at);
                }
                other => return Err(format!("M{other}")),
            }
        }
        Ok(ends)
    }

    fn reference(&mut self, block: &Block<'_>, line: usize) {
        let mut to = self.at;
        for (axis, letter) in b"XYZABC".iter().enumerate() {
            if block.get(*letter).is_some() {
                to[axis] = f64::NAN;
            }
        }
        // with an intermediate position, the tool moves there first
        let by = self.target(block, false);
        let passes =
            (0..3).any(|axis| block.get(b"XYZ"[axis]).is_some() && by[axis] != self.at[axis] && !by[axis].is_nan());
        if passes {
            self.act(line, What::Rapid, by);
        }
        self.act(line, What::Rapid, to);
    }

    /// The target of the axis words in a block.
    fn target(&self, block: &Block<'_>, machine_place: bool) -> Place {
        let mut to = self.at;
        for (axis, letter) in b"XYZABC".iter().enumerate() {
            let Some(number) = block.get(*letter) else { continue };
            let number = if axis < 3 { number * self.scale } else { number };
            to[axis] = match (machine_place, self.absolute) {
                (true, _) => f64::NAN,
                (false, true) => number + self.shift.get(axis).unwrap_or(&0.0),
                (false, false) => to[axis] + number,
            };
        }
        let by_machine = self.family == Family::Fadal;
        if by_machine && self.state.length.is_none() && block.get(b'Z').is_some() {
            to[2] = f64::NAN;
        }
        if by_machine && self.state.work == 0.0 {
            (0..2).filter(|&axis| block.get(b"XY"[axis]).is_some()).for_each(|axis| to[axis] = f64::NAN);
        }
        to
    }

    fn moves(
        &mut self,
        block: &Block<'_>,
        motion: Option<f64>,
        machine_place: bool,
        line: usize,
    ) -> Result<(), String> {
        // G77 and G78 of a Brother are taps with a pitch
        let motion = motion.map(|code| match code {
            77.0 if self.control == "brother" => 84.0,
            78.0 if self.control == "brother" => 74.0,
            code => code,
        });
        if let Some(code) = motion {
            let is_new = self.cycle.as_ref().is_none_or(|cycle| cycle.code != code);
            if is_cycle(code) && is_new {
                let initial = self.cycle.as_ref().map_or(self.at[2], |cycle| cycle.initial);
                self.cycle =
                    Some(Cycle { code, r: None, z: None, q: f64::NAN, p: 0.0, jog: [0.0; 2], initial, pitch: None });
            } else if !is_cycle(code) {
                self.cycle = None;
                self.motion_before = code;
            }
            self.motion = code;
        }
        let axes = b"XYZABC".iter().any(|letter| block.get(*letter).is_some());
        let centre = b"IJK".iter().any(|letter| block.get(*letter).is_some());
        if self.cycle.is_some() && !machine_place {
            return match axes || block.get(b'R').is_some() {
                true => self.hole(block, line),
                false => Ok(()),
            };
        }
        if !(axes || centre && matches!(self.motion, 2.0 | 3.0)) {
            return Ok(());
        }
        let to = self.target(block, machine_place);
        match self.motion {
            _ if machine_place => self.act(line, What::Rapid, to),
            0.0 => self.act(line, What::Rapid, to),
            1.0 => {
                if self.state.feed.0.is_nan() {
                    return Err("no feed".into());
                }
                self.act(line, What::Feed, to);
            }
            2.0 | 3.0 => self.arc(block, to, line)?,
            other => return Err(format!("axis words under G{other}")),
        }
        Ok(())
    }
}
