//! The program's side: its cuts, each with the way that leads to it.

use std::io::{BufRead, Seek};

use super::cut::{Cut, Place, Rapid, State, What};
use super::finding::Finding;
use crate::diag::{Code, Diag};
use crate::nc::{Action, Cooling, Item, Position, Rotation, RunError, Settings, Simulator};
use crate::toolpath::{FeedMode, StopKind, Units};

/// A program that is run as far as it was asked for.
pub(super) struct Program<R> {
    simulator: Simulator<R>,
    items: Vec<Item>,
    next: usize,
    over: bool,
    /// Where the tool is.
    at: Place,
    unknown: u8,
    state: State,
    mode: FeedMode,
    cycle: bool,
    /// The tool's missing length offset was told.
    length_told: bool,
    lengths: bool,
    linuxcnc: bool,
    units_said: bool,
    units: Units,
    /// Units that places are wanted in.
    wanted: Units,
    start: Rapid,
    /// The way to the cut.
    pub way: Vec<Rapid>,
    /// How many of its rapids come before a change of tool or work offset, after which places are others.
    pub before: Option<usize>,
    /// Length register and work offset of the rapids on the way whose height is known.
    pub moved_with: Vec<[Option<f64>; 2]>,
    /// Stops on the way, and whether the tool stood in a cut.
    pub stops: Vec<(StopKind, bool)>,
    /// Dwells on the way.
    pub waits: Vec<f64>,
    /// How the spindle was switched on the way.
    pub turns: Vec<Rotation>,
    /// Codes on the way that are not simulated: letter, and ten times the number.
    pub codes: Vec<(u8, u16)>,
    cuts: bool,
    cut: Option<Cut>,
    /// Hazards on the way.
    pub hazards: Vec<Finding>,
}

impl<R: BufRead + Seek> Program<R> {
    /// Runs with these settings; `lengths`: tools need their length offset.
    ///
    /// `units_due`: nothing but the program says its units.
    pub fn new(input: R, settings: Settings, lengths: bool, units_due: bool) -> Program<R> {
        let settings = Settings { places_unknown: true, bore_shift: -1.0, ..settings };
        Program {
            simulator: Simulator::new(input, settings),
            items: Vec::new(),
            next: 0,
            over: false,
            at: [0.0; 6],
            unknown: 0b111,
            // as switched on
            state: State {
                side: Some(None),
                rotation: Some(Rotation::Stop),
                speed: Some(0.0),
                coolant: Some(Cooling::Off),
                work: settings.control.traits().work_letter.is_none().then_some(54.0),
                ..State::default()
            },
            mode: FeedMode::PerMinute,
            cycle: false,
            length_told: false,
            lengths,
            linuxcnc: settings.control.is_linuxcnc(),
            units_said: !units_due,
            units: settings.units,
            wanted: settings.units,
            start: Rapid { to: [0.0; 6], unknown: 0b111, rotation: None },
            way: Vec::new(),
            before: None,
            moved_with: Vec::new(),
            stops: Vec::new(),
            waits: Vec::new(),
            turns: Vec::new(),
            codes: Vec::new(),
            cuts: false,
            cut: None,
            hazards: Vec::new(),
        }
    }

    /// In which units it counts before it says so.
    pub fn begin_in(&mut self, units: Units) {
        self.simulator.begin_in(units);
        self.units = units;
    }

    /// In which units places are wanted.
    pub fn want(&mut self, units: Units) {
        self.wanted = units;
    }

    /// The next cut, which stays until it is taken; `None` at the program's end.
    ///
    /// # Errors
    /// The program can't be read, or its control refuses a block.
    pub fn peek(&mut self) -> Result<Option<Cut>, RunError> {
        while self.cut.is_none() {
            if self.next == self.items.len() {
                if self.over {
                    return Ok(None);
                }
                self.items.clear();
                self.next = 0;
                self.over = !self.simulator.step(&mut self.items)?;
                continue;
            }
            let item = self.items[self.next].clone();
            self.next += 1;
            self.take_item(&item);
        }
        Ok(self.cut)
    }

    /// The cut is dealt with.
    pub fn take(&mut self) {
        if let Some(cut) = self.cut.take() {
            self.at = cut.what.end(&cut.from);
            // a cut may say a height that was unknown
            self.unknown = self.simulator.machine().at_machine();
            self.start = Rapid { to: self.at, unknown: self.unknown, rotation: cut.state.rotation };
            self.way.clear();
            self.before = None;
            self.stops.clear();
            self.waits.clear();
            self.turns.clear();
            self.codes.clear();
            self.moved_with.clear();
            self.cuts = true;
        }
    }

    /// Where the way began: at the end of the last cut.
    pub fn start(&self) -> Rapid {
        self.start
    }

    /// The text of the line that is being run.
    pub fn text(&self) -> String {
        String::from_utf8_lossy(self.simulator.text()).trim().to_owned()
    }

    /// Warnings of the simulator.
    pub fn warnings(&mut self) -> Vec<Diag> {
        self.simulator.take_warnings()
    }

    fn scaled(&self, to: &Position) -> Place {
        let mut place = *to;
        if self.units != self.wanted {
            let factor = if self.units == Units::Inch { 25.4 } else { 1.0 / 25.4 };
            place[..3].iter_mut().for_each(|value| *value *= factor);
        }
        place
    }

    fn factor(&self) -> f64 {
        match (self.units, self.wanted) {
            (Units::Inch, Units::Mm) => 25.4,
            (Units::Mm, Units::Inch) => 1.0 / 25.4,
            _ => 1.0,
        }
    }

    fn take_item(&mut self, item: &Item) {
        let turned = self.state.rotation;
        let cut = |program: &Self, what: What, feed: Option<f64>| Cut {
            from: program.at,
            unknown: program.unknown,
            what,
            feed,
            mode: program.mode,
            state: program.state,
            by_cycle: item.by_cycle,
            line: item.line,
        };
        let feed_of = |program: &Self, feed: f64| {
            Some(if program.mode == FeedMode::InverseTime { feed } else { feed * program.factor() })
        };
        match &item.action {
            Action::Rapid { to, machine } => {
                let to = self.scaled(to);
                self.unknown = *machine;
                if *machine & 0b100 == 0 {
                    let with = [self.state.length, self.state.work];
                    if to[2] != self.at[2] && self.length_is_due() {
                        self.without_length(item.line, "the tool goes down, and its length offset is not on");
                    }
                    if self.moved_with.last() != Some(&with) {
                        self.moved_with.push(with);
                    }
                }
                self.at = to;
                self.way.push(Rapid { to, unknown: *machine, rotation: self.state.rotation });
            }
            Action::Feed { to, feed, lead } => {
                // a feed that follows the spindle
                let feed = match (lead, self.mode, self.state.speed) {
                    (Some(lead), FeedMode::PerMinute, Some(speed)) => lead * speed,
                    (Some(lead), FeedMode::PerRev, _) => *lead,
                    _ => *feed,
                };
                let to = self.scaled(to);
                if to == self.at && self.unknown == 0 {
                    return; // a move of no length cuts nothing
                }
                self.check_length(item.line);
                self.cut = Some(cut(self, What::Line { to }, feed_of(self, feed)));
            }
            Action::Arc(turn) => {
                let mut turn = *turn;
                turn.to = self.scaled(&turn.to);
                let factor = self.factor();
                turn.center.iter_mut().for_each(|value| *value *= factor);
                self.check_length(item.line);
                self.cut = Some(cut(self, What::Arc(turn), feed_of(self, turn.feed)));
            }
            // one that does not follow a cut only waits
            Action::Dwell(seconds) if *seconds > 0.0 && self.way.is_empty() => {
                self.cut = Some(cut(self, What::Dwell(*seconds), None));
            }
            Action::Dwell(seconds) if *seconds > 0.0 => self.waits.push(*seconds),
            Action::Stop(kind) => {
                self.stops.push((*kind, self.cuts && self.way.is_empty() && !item.by_cycle));
                // a Haas stops the spindle, and no form may count on another control's going on
                if *kind == StopKind::Program && !item.by_cycle && !self.linuxcnc {
                    self.state.rotation = Some(Rotation::Stop);
                }
                // without tool changes, the operator changes the tool
                if *kind == StopKind::Program && !self.lengths {
                    self.before = Some(self.way.len());
                }
            }
            Action::Spindle(rotation, speed) => {
                self.state.rotation = Some(*rotation);
                self.state.speed = Some(*speed);
            }
            Action::Orient(_) => self.state.rotation = Some(Rotation::Stop),
            Action::Tool(number) => {
                if self.cycle {
                    self.hazard(
                        Code::PV013,
                        item.line,
                        "a canned cycle is still in force at a tool change",
                        "end it with G80",
                    );
                }
                if self.state.tool != Some(*number) {
                    self.before = Some(self.way.len());
                }
                if self.state.tool != Some(*number) {
                    self.state.length = None;
                    self.length_told = false;
                }
                self.state.tool = Some(*number);
                self.state.rotation = Some(Rotation::Stop);
                self.unknown |= 0b100;
            }
            Action::Length(register) => self.state.length = *register,
            Action::Units(units) => {
                self.units = *units;
                self.units_said = true;
            }
            Action::SurfaceSpeed(limit) => self.state.css = limit.is_some(),
            Action::Plane(plane) => self.state.plane = *plane,
            Action::Frame | Action::LeftOut(b'G', 100) => {
                let message = "the program moves its coordinate frame: the job's places lie elsewhere then";
                self.hazard(Code::PV021, item.line, message, "take G10, G52 or G92 out");
            }
            Action::FeedMode(mode) => self.mode = *mode,
            Action::Work(code) if self.state.work != Some(*code) => {
                self.before = Some(self.way.len());
                self.state.work = Some(*code);
            }
            Action::Compensation(side) => {
                self.state.side = Some(side.map(|(side, _)| side));
                self.state.diameter = side.and_then(|(_, register)| register);
            }
            Action::Hole(_) => self.cycle = true,
            Action::CycleOff => self.cycle = false,
            Action::End if self.cycle => {
                self.hazard(Code::PV013, item.line, "a canned cycle is still in force at the end", "end it with G80");
            }
            Action::Coolant(cooling) => self.state.coolant = Some(*cooling),
            Action::LeftOut(letter, tenths) => self.codes.push((*letter, *tenths)),
            _ => {}
        }
        if self.state.rotation != turned {
            self.turns.extend(self.state.rotation);
        }
    }

    /// Before a cut: what must have been said.
    fn check_length(&mut self, line: u64) {
        if self.length_is_due() {
            self.without_length(line, "the tool cuts, and its length offset is not on");
        }
        if !std::mem::replace(&mut self.units_said, true) {
            let message = "the program cuts before it says its units";
            self.hazard(
                Code::PV022,
                line,
                message,
                "print G[unitmode] in StartCode, or give the form, if it is for one unit",
            );
        }
    }

    fn length_is_due(&self) -> bool {
        self.lengths && self.state.tool.is_some() && self.state.length.is_none()
    }

    fn without_length(&mut self, line: u64, message: &str) {
        if !std::mem::replace(&mut self.length_told, true) {
            self.hazard(Code::PV014, line, message, "print G43 H[lcomp] in the tool change, before the height");
        }
    }

    /// What the program did before its end, besides cutting.
    pub fn ended(&mut self) {
        if self.simulator.begins_again() {
            let line = self.simulator.line();
            self.hazard(Code::PV016, line, "the program ends with M99, which begins it again", "end it with M30 or M2");
        }
    }

    fn hazard(&mut self, code: Code, line: u64, message: &str, help: &'static str) {
        // told once: a form makes the same mistake at every tool
        if self.hazards.iter().any(|told| told.code == code && told.message == message) {
            return;
        }
        let block = self.text();
        self.hazards.push(Finding { code, message: message.into(), help, place: None, line, block });
    }
}
