//! The program's side of the comparison: the program's cuts, each with everything between the previous cut and this
//! cut.

mod beam;
mod doubt;
mod hazards;
mod motions;
mod next_hole;
mod plain;
mod texts;
mod tools;
mod zero;

use std::io::{Read, Seek};
use std::rc::Rc;

use beam::Switched;
pub(super) use doubt::Doubt;

use super::cooled;
use super::cut::{Cut, Place, Rapid, Shared, Spin, State, place};
use super::expectation::{Expectation, taps_ahead};
use super::finding::Finding;
use super::measured::Frames;
use super::passage::{Frame, Passage};
use super::recent_lines::Recent;
use super::scale::Scale;
use super::unset::Due;
use super::wire_codes::Codes;
use crate::control::{self, Control, Kept, Meaning};
use crate::diag::{Code, Diag};
use crate::lang::{Coolant, Machine};
use crate::nc::{Action, Item, Rotation, RunError, RunSettings, Simulator};
use crate::toolpath::{self, FeedMode, Plane, StopKind, Units};

/// A program that is simulated only as far as the comparison needs.
pub(super) struct Program<'a> {
    simulator: Simulator<'a>,
    control: &'static Control,
    items: Vec<Item>,
    next: usize,
    over: bool,
    recent: Recent,
    /// Position of the tool.
    at: Place,
    unknown: u8,
    /// Of the axes in `unknown`, the axes whose machine position is given in the program.
    placed: u8,
    /// Whether the tool length offset has changed since the last move. The same position is then another height of the
    /// machine.
    is_relengthened: bool,
    state: Shared,
    /// The active frames, if the frames of rapids are compared.
    frames: Option<Rc<Frames>>,
    spin: Spin,
    /// Whether M29 was run, and no axis has moved since.
    is_rigid_ahead: bool,
    mode: FeedMode,
    cycle: bool,
    /// Whether the next hole may be compared by its position only.
    is_alike: bool,
    /// Rotation of the spindle before the tapping cycle of a control, because this cycle starts the spindle itself.
    before_tap: Option<Option<Rotation>>,
    due: Due,
    scale: Scale,
    /// State of the torch or laser.
    beam: Option<Switched>,
    /// The form's codes for threading and cutting a wire.
    pub wire: Codes,
    /// Coolant codes of the form.
    coolant: cooled::Codes,
    /// Everything between the last cut and the next cut.
    pub passage: Passage,
    /// Whether the program has moved its zero or has set tool data.
    pub moves_zero: bool,
    /// Whether the program has set its units.
    pub sets_units: bool,
    cuts: bool,
    /// The reason why the current cut can't be compared.
    doubt: Option<Doubt>,
    /// Whether a code ended the program.
    ended: bool,
    /// An error while running ahead. The error is returned when the next cut is requested.
    failed: Option<RunError>,
    cut: Option<Cut>,
    /// Hazards found so far.
    pub hazards: Vec<Finding>,
}

impl<'a> Program<'a> {
    /// A program that runs with these settings. The form defines the meaning of some words of the program.
    pub fn new(input: impl Read + Seek + 'a, settings: RunSettings, expectation: &Expectation) -> Program<'a> {
        let settings = RunSettings { places_unknown: true, bore_shift: -1.0, ..settings };
        // the state after power-on
        let state = State {
            side: Some(None),
            rotation: Some(Rotation::Stop),
            speed: Some(0.0),
            coolant: Some(Coolant::OFF),
            work: settings.control.first_work(),
            rigid: taps_ahead(settings.control).then_some(false),
            ..State::default()
        };
        let start = Rapid { to: place(&[0.0; 6]), unknown: 0b111, kept: 0, spin: None };
        let wire = settings.control.is_wire().then_some(0b1100);
        Program {
            simulator: Simulator::new(input, settings),
            control: settings.control,
            items: Vec::new(),
            next: 0,
            over: false,
            recent: Recent::default(),
            at: place(&[0.0; 6]),
            unknown: 0b111,
            placed: 0,
            is_relengthened: false,
            state: state.into(),
            frames: None,
            spin: Spin::Turns(Rotation::Stop),
            is_rigid_ahead: false,
            mode: FeedMode::PerMinute,
            cycle: false,
            is_alike: false,
            before_tap: None,
            due: Due::new(expectation, settings.control),
            scale: Scale {
                units: settings.units,
                wanted: settings.units,
                axes: expectation.axes,
                lathe: false,
                flat: expectation.is_flat,
                wire,
            },
            beam: expectation.beam.map(|beam| Switched::new(beam, settings.control)),
            wire: expectation.wire.clone().unwrap_or_default(),
            coolant: expectation.coolant.clone(),
            passage: Passage::new(Some(start), Frame { tool: None, work: state.work }),
            moves_zero: false,
            sets_units: false,
            cuts: false,
            doubt: None,
            ended: false,
            failed: None,
            cut: None,
            hazards: Vec::new(),
        }
    }

    /// Sets the units that apply until the program sets its own units.
    pub fn begin_in(&mut self, units: Units) {
        self.simulator.begin_in(units);
        self.scale.units = units;
    }

    /// Sets the number of subprograms before the main program. Each subprogram begins with an O word.
    pub fn begin_behind(&mut self, subprograms: usize) {
        self.simulator.begin_behind(subprograms);
    }

    /// Runs the program as a lathe program. Call this function before the first block is run.
    pub fn is_of_lathe(&mut self, by_diameter: bool) {
        self.scale.lathe = true;
        self.simulator.is_of_lathe(by_diameter);
        self.control = self.control.of_lathe();
        self.state.plane = Plane::Xz;
        self.begins(0b101);
    }

    /// Runs the program as a wire EDM program. Call this function before the first block is run.
    pub fn is_of_wire(&mut self) {
        self.scale.wire = Some(0b1100);
        self.simulator.is_of_wire();
        self.control = self.control.of_wire();
        self.begins(0b011);
    }

    /// The machine that runs the program, as far as the program up to here shows. A control without a control file for
    /// lathes, such as LinuxCNC, runs mills and lathes: a program of a lathe never gives Y.
    pub fn machine(&self) -> Machine {
        let has_no_y = |at: &Rapid| at.unknown & 0b010 != 0;
        let turns = || has_no_y(&self.start()) && self.passage.rapids.iter().all(has_no_y);
        match self.control {
            control if control.is_wire() => Machine::Edm,
            control if control.is_lathe() || turns() => Machine::Lathe,
            _ => Machine::Mill,
        }
    }

    /// Sets the start of the program to a position that is known only at the machine. `unknown`: the axes whose
    /// position is unknown.
    fn begins(&mut self, unknown: u8) {
        self.unknown = unknown;
        let start = Rapid { to: place(&[0.0; 6]), unknown, kept: 0, spin: None };
        self.passage = Passage::new(Some(start), self.frame());
    }

    /// Sets the units in which positions are compared.
    pub fn want(&mut self, units: Units) {
        self.scale.wanted = units;
    }

    /// The cut that the program has reached and that has not been ended yet.
    pub fn cut(&self) -> Option<&Cut> {
        self.cut.as_ref()
    }

    /// Runs the program to its next cut. The cut stays the current cut until [`Program::take`] ends it. `None`: the
    /// program has ended, or the passage before the cut is too long ([`Doubt::TooLong`]).
    ///
    /// # Errors
    /// The program can't be read, or its control refuses a block.
    pub fn run_to_cut(&mut self) -> Result<Option<&Cut>, RunError> {
        if let Some(error) = self.failed.take() {
            return Err(error);
        }
        while self.goes_on()? {}
        Ok(self.cut())
    }

    /// The reason why the current cut can't be compared.
    #[inline]
    pub fn doubt(&self) -> Option<Doubt> {
        self.doubt
    }

    /// Runs the program ahead, up to its next cut, while more text waits. This part of the program does not depend on
    /// the job's events before the job's next cut.
    pub fn run_on(&mut self, waits: &dyn Fn() -> bool) {
        while self.failed.is_none() && waits() {
            match self.goes_on() {
                Ok(true) => {}
                Ok(false) => break,
                Err(error) => self.failed = Some(error),
            }
        }
    }

    /// Whether an error occurred while the program ran ahead of the job.
    pub fn has_failed(&self) -> bool {
        self.failed.is_some()
    }

    /// Processes the actions of the last block up to its next cut. If the last block has no cut, runs the next block.
    /// Returns `false` at a cut, at the end of the program, or if the passage is too long.
    #[inline]
    fn goes_on(&mut self) -> Result<bool, RunError> {
        self.is_alike = false;
        if self.next < self.items.len() {
            let items = std::mem::take(&mut self.items);
            while self.cut.is_none()
                && let Some(item) = items.get(self.next)
            {
                self.take_item(item);
                self.next += 1;
            }
            self.items = items;
            if self.cut.is_none() && self.passage.is_too_long() {
                self.doubt = Some(Doubt::TooLong);
            }
        }
        // Grbl would accept more blocks after M2 or M30 if its sender continued, but nothing is compared after the end
        if self.cut.is_some() || self.over || self.ended || self.doubt == Some(Doubt::TooLong) {
            return Ok(false);
        }
        self.run_block()?;
        Ok(true)
    }

    /// Ends the current cut.
    pub fn take(&mut self) {
        if let Some(cut) = self.cut.take() {
            self.doubt = None;
            self.ends_cut(cut.end());
        }
    }

    /// Skips the current cut: the passage before it continues to the next cut.
    pub fn pass_over(&mut self) {
        if let Some(cut) = self.cut.take() {
            self.at = cut.end();
            self.passage.goes_on(self.at);
        }
    }

    /// The beginning of the path, which is the end of the last cut.
    pub fn start(&self) -> Rapid {
        self.passage.start.unwrap_or(Rapid { to: self.at, unknown: 0b111, kept: 0, spin: None })
    }

    /// The state of the spindle now.
    pub fn spin(&self) -> Spin {
        self.spin
    }

    /// The control that runs the program.
    pub fn control(&self) -> &'static Control {
        self.control
    }

    /// The end of the program, as text for a message.
    pub fn ending(&self) -> &'static str {
        match self.ended {
            true => "ends with M2, M30 or the like",
            false if self.simulator.begins_again() => "ends with M99, which starts it again",
            false => "has no end",
        }
    }

    /// Whether the program has had a block with a slash.
    pub fn has_slash(&self) -> bool {
        self.simulator.has_slash()
    }

    /// Takes the warnings of the simulator.
    pub fn warnings(&mut self) -> Vec<Diag> {
        self.simulator.take_warnings()
    }

    fn frame(&self) -> Frame {
        Frame { tool: self.state.tool, work: self.state.work }
    }

    fn changed(&mut self) {
        let frame = self.frame();
        self.passage.change(frame);
    }

    fn take_item(&mut self, item: &Item) {
        let turned = self.state.rotation;
        if let Some(unsaid) = &mut self.scale.wire {
            *unsaid = self.simulator.state().at_machine();
        }
        if self.is_rigid_ahead {
            self.moves_after_rigid(item);
        }
        match &item.action {
            Action::Rapid { to, machine, astray, placed, kept } => {
                self.rapid(to, [*machine, *astray, *placed, *kept], item.line);
            }
            Action::Threading(words) => self.state.thread = *words,
            Action::Feed { to, feed, lead, home, .. } => self.feed(to, (*feed, *lead), *home, item),
            Action::Arc(turn) => self.arc(*turn, item),
            Action::Dwell(seconds) if *seconds > 0.0 => {
                let mark = self.passage.mark(*seconds, item.line, toolpath::Place::default());
                self.passage.waits.push(mark);
            }
            Action::Stop(kind) => self.stop(*kind, item),
            // Grbl ignores M1, like other controls whose optional stop is off
            Action::LeftOut(_, Meaning::StopOptional) => self.stop(StopKind::Optional, item),
            // a speed without a direction does not start the spindle
            Action::Spindle(_, speed) if !item.by_cycle && self.simulator.only_says_speed() => {
                self.state.speed = Some(*speed);
            }
            Action::Spindle(rotation, speed) => {
                if !item.by_cycle {
                    self.before_tap = None;
                }
                self.state.rotation = Some(*rotation);
                self.state.speed = Some(*speed);
                self.spin = Spin::Turns(*rotation);
            }
            Action::Orient(angle) => {
                self.state.rotation = Some(Rotation::Stop);
                self.spin = angle.map_or(Spin::Oriented, Spin::At);
            }
            Action::Tool(number) => self.tool(*number, item.line),
            Action::Length(register) => self.length(*register, item.line),
            Action::Units(units) => {
                self.scale.units = *units;
                self.sets_units = true;
                self.due.units_are_set();
            }
            Action::SurfaceSpeed(limit) => {
                self.state.css = limit.is_some();
                self.state.limit = limit.filter(|limit| *limit > 0.0).or(self.state.limit);
            }
            Action::SpeedLimit(limit) => self.state.limit = Some(*limit),
            Action::Plane(plane) => self.state.plane = *plane,
            Action::Frame | Action::LeftOut(_, Meaning::SetOffsets) => self.zero_moves(&item.action, item.line),
            Action::FeedMode(mode) => self.mode = *mode,
            Action::Work(code) if self.state.work != Some(*code) => {
                self.state.work = Some(*code);
                self.unknown |= self.scale.unknown(0b111);
                self.changed();
            }
            Action::Compensation(on) => self.compensation(*on, item.line),
            Action::Hole(hole) => self.hole(hole.cycle),
            Action::CycleOff => self.cycle_ends(),
            Action::End => {
                self.ended = true;
                if self.cycle {
                    let message = "a canned cycle is still active at the end";
                    self.hazard(Code::PV013, item.line, message, "end it with G80");
                }
            }
            Action::Coolant(kind) => {
                self.state.coolant = Some(self.state.coolant.unwrap_or_default().then(*kind));
            }
            Action::LeftOut(code, meaning) => {
                let coded = (code.letter, code.tenths);
                if self.wire.iter().any(|(_, codes)| codes.contains(&coded)) {
                    let mark = self.passage.mark(coded, item.line, toolpath::Place::default());
                    self.passage.does.push(mark);
                }
                self.left_out(*code, *meaning);
            }
            Action::LeftOutWord(word) => self.passage.words.push(word.clone()),
            _ => {}
        }
        if !matches!(item.action, Action::Rapid { .. } | Action::Feed { .. } | Action::Arc(_) | Action::Hole(_)) {
            self.reframe();
        }
        if let Some(is_on) = self.beam_is_on() {
            self.passage.is_off = !is_on;
        }
        if self.state.rotation != turned {
            self.passage.started |= turned == Some(Rotation::Stop);
            self.passage.turns.extend(self.state.rotation);
        }
    }

    fn stop(&mut self, kind: StopKind, item: &Item) {
        let mark = self.passage.mark(kind, item.line, toolpath::Place::default());
        self.passage.stops.push(mark);
        // unless the control keeps the spindle turning, a program must not rely on a running spindle
        let stops = match self.control.traits().spindle_at_stop {
            Kept::Yes => false,
            Kept::Unknown => kind == StopKind::Program,
            Kept::No => true,
        };
        if stops && !item.by_cycle {
            self.state.rotation = Some(Rotation::Stop);
            self.state.coolant = Some(Coolant::OFF);
            self.spin = Spin::Turns(Rotation::Stop);
        }
    }

    fn tool(&mut self, number: f64, line: u64) {
        if self.cycle {
            let message = "a canned cycle is still active at a tool change";
            self.hazard(Code::PV013, line, message, "end it with G80");
        }
        if self.state.tool != Some(number) {
            self.state.tool = Some(number);
            self.state.length = None;
            self.due.new_tool();
            self.changed();
            if self.control.is_lathe() {
                self.passage.turrets.push(self.placed & 0b101);
            }
        } else {
            let mark = self.passage.mark((), line, toolpath::Place::default());
            self.passage.reloads.push(mark);
        }
        if self.control.is_lathe() {
            self.unknown |= 0b101; // the turret indexes, so X and Z are unknown
            return;
        }
        self.state.rotation = Some(Rotation::Stop);
        self.spin = Spin::Turns(Rotation::Stop);
        self.unknown |= 0b100;
    }

    /// Handles a code that is not simulated. The code may be a coolant code of the form, or the code that makes the
    /// next tap rigid.
    fn left_out(&mut self, code: control::Code, meaning: Meaning) {
        self.passage.codes.push((code.letter, f64::from(code.tenths) / 10.0));
        self.passage.codes.extend(self.simulator.words_of(code));
        if meaning == Meaning::RigidAhead && self.state.rigid.is_some() {
            self.state.rigid = Some(true);
            self.is_rigid_ahead = true;
        }
        self.state.coolant = self.coolant.after(code, self.state.coolant);
    }
}
