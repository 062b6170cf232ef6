//! The job's side of the comparison: converts the events of the job to the cuts and paths that the program must make.

use super::beside::Compensated;
use super::cut::{Cut, Place, Rapid, Shared, Spin, State, UNSAID, What, place};
use super::expectation::Expectation;
use super::form_values::{by, made_by};
use super::intent::{Done, Intent, Straight, unproven};
use super::passage::Frame;
use super::planned_holes::Open;
use super::subprograms::Subprograms;
use super::tables::Unmodelled;
use crate::control::{Control, Group, Meaning, ToolLength};
use crate::cycle::{Steps, check};
use crate::diag::Diag;
use crate::lang::{Beam, Coolant, Machine};
use crate::nc::{Kind, Rotation, Turn, coolant_of, rotation_of, tokens};
use crate::toolpath::{
    Arc, Axes, Direction, EdmAction, Event, FeedMode, First, Order, Plane, Side, Spindle, SpindleTurn, Start, StopKind,
    Tool, ToolChange, Units,
};

/// Current state of the job.
pub(super) struct Job {
    pub(super) expectation: Expectation,
    pub(super) control: &'static Control,
    order: Order,
    pub units: Option<Units>,
    pub(super) at: Axes,
    pub(super) feed: Option<f64>,
    pub(super) mode: FeedMode,
    pub state: Shared,
    pub(super) css: bool,
    pub(super) cycle: Option<Open>,
    diameter: Option<f64>,
    pub(super) steps: Steps,
    compensation: bool,
    machine: Machine,
    /// The tool's number in the job.
    tool: Option<f64>,
    /// Kinds of events in the job so far. Of the events that print a cut, only those after the last spindle event are
    /// included.
    by: u8,
    /// The kind of event that prints the current cut.
    cuts_by: u8,
    pub(super) subprograms: Subprograms,
}

impl Job {
    /// A job for a form and a control.
    pub fn new(expectation: Expectation, control: &'static Control) -> Job {
        let work = expectation.work;
        Job {
            expectation,
            control,
            order: Order::default(),
            units: None,
            at: Axes::default(),
            feed: None,
            mode: FeedMode::PerMinute,
            state: Shared::from(State { side: Some(None), work, ..State::default() }),
            css: false,
            cycle: None,
            diameter: None,
            steps: Steps::default(),
            compensation: false,
            machine: Machine::Mill,
            tool: None,
            by: by::JOB,
            cuts_by: by::JOB,
            subprograms: Subprograms::default(),
        }
    }

    /// Processes an event of the job and passes the motions of the event on to `to`.
    ///
    /// # Errors
    /// The effect of the event is unknown, or a difference ended the comparison.
    pub fn event(&mut self, event: Event<'_>, to: &mut impl Intent) -> Done {
        self.order.follow(&event)?;
        if self.subprograms.hold(&event, to.place())? { Ok(()) } else { self.act(event, to) }
    }

    /// Runs an event.
    pub(super) fn act(&mut self, event: Event<'_>, to: &mut impl Intent) -> Done {
        self.cuts_by = made_by(&event);
        self.by |= self.cuts_by;
        match event {
            Event::Start(start) => self.start(start, to),
            Event::ToolChange(change) => self.tool_change(change, to),
            Event::Rapid(target) => {
                let target = self.target(&target);
                self.at = target;
                to.rapid(self.rapid_to(&target, None))
            }
            Event::Line { to: target, feed } => {
                self.feed = feed.or(self.feed);
                let target = self.target(&target);
                self.line_to(target, to)
            }
            Event::Arc { arc, feed } => {
                self.feed = feed.or(self.feed);
                self.arc(arc, to)
            }
            Event::Infeed { infeed, feed } => {
                self.feed = feed.or(self.feed);
                self.compensated(&infeed.to, Some(infeed.side), infeed.rapid, to)
            }
            Event::Outfeed { to: target, feed, rapid } => {
                self.feed = feed.or(self.feed);
                self.compensated(&target, None, rapid, to)
            }
            Event::CycleBegin(spec) => {
                self.cycle = Some(Open::new(spec.clone()));
                check(spec).map_err(Box::<Diag>::from)
            }
            Event::Hole(hole) => self.hole(&hole, to),
            Event::CycleEnd => {
                self.cycle = None;
                Ok(())
            }
            Event::Dwell(seconds) => {
                wait(seconds, to);
                Ok(())
            }
            Event::Stop(kind) => {
                to.stop(kind);
                Ok(())
            }
            Event::Home => {
                self.at = Axes { given: self.at.given & !0b111, ..self.at };
                to.home(self.state.length);
                Ok(())
            }
            Event::Feed(feed) => {
                self.feed = Some(feed);
                Ok(())
            }
            Event::Work(work) => {
                self.work(work, to);
                Ok(())
            }
            Event::Spindle(spindle) => {
                self.spindle(&spindle);
                Ok(())
            }
            Event::Coolant(coolant) => {
                self.state.coolant = self.expectation.coolant.of_job(coolant, self.control);
                Ok(())
            }
            Event::Text(text) => self.text(text, to),
            Event::Tilt(_) => unproven(Unmodelled::Tilted),
            Event::SubCall(call) => self.call(call, to),
            Event::Thread(thread) if self.is_lathe() => self.thread(thread, to),
            Event::Thread(_) => unproven(Unmodelled::Threads),
            Event::Edm(action) => self.wire(action, to),
            Event::Begin(_)
            | Event::End(_)
            | Event::Comment(_)
            | Event::Set(..)
            | Event::SubStart(_)
            | Event::SubEnd => Ok(()),
            Event::Finish => to.finish(),
        }
    }

    fn start(&mut self, start: &Start, to: &mut impl Intent) -> Done {
        self.machine = start.machine;
        self.state.plane = if self.is_lathe() { Plane::Xz } else { Plane::Xy };
        match start.machine {
            Machine::Mill => {}
            Machine::Lathe => to.is_of_lathe(self.expectation.by_diameter),
            Machine::Edm if self.control.of_wire().is_wire() => to.is_of_wire(),
            Machine::Edm => return unproven(Unmodelled::Machine),
        }
        self.units = Some(start.units);
        let row = usize::from(start.units == Units::Mm);
        to.units(start.units, self.expectation.chord[row], self.expectation.increment[row]);
        Ok(())
    }

    fn is_lathe(&self) -> bool {
        self.machine == Machine::Lathe
    }

    fn tool_change(&mut self, change: &ToolChange, to: &mut impl Intent) -> Done {
        let tool = self.tool;
        if let Some(tool) = change.changes_to(tool) {
            self.tool = Some(tool.number);
            self.state.tool = Some(tool.number);
            if let Some(name) = &tool.name {
                to.tool_name(name, tool.number);
                for width in &self.expectation.name_widths {
                    to.tool_name(&name.chars().take(*width).collect::<String>(), tool.number);
                }
            }
            let [length, diameter] =
                self.expectation.registers.map_or([None; 2], |by| by.map(|by| Some(tool.number + by)));
            let lengths = self.control.traits().tool_length;
            let register = match lengths {
                ToolLength::None => None,
                // register 0 is no length, also where the length belongs to the tool
                ToolLength::Tool => tool.length_offset.filter(|own| *own == 0.0).or(Some(tool.number)),
                _ => tool.length_offset.or(length),
            };
            self.state.length = register.filter(|_| self.expectation.tools);
            let has_registers = !self.is_lathe() && lengths != ToolLength::Tool;
            self.diameter = tool.diameter_offset.or(diameter).filter(|_| has_registers);
            if self.is_lathe() && self.control.of_lathe().is_lathe() {
                let [number, register] = turret(tool, length);
                (self.state.tool, self.state.length) = (number, register);
            }
            (self.state.speed, self.state.rotation) = (None, None);
            self.counts_speed(false);
            self.state.coolant = Some(Coolant::OFF);
            self.at = Axes { given: self.at.given & !0b111, ..self.at };
            self.changed(true, to);
        }
        if let Some(spindle) = change.spindle {
            self.spindle(&spindle.of_operation());
        }
        if let Some(coolant) = change.coolant {
            self.state.coolant = self.expectation.coolant.of_job(coolant, self.control);
        }
        let work = self.state.work;
        if let Some(work) = change.work {
            self.work(work, to);
        }
        if let First::Rapid(first) = &change.first {
            let first = Axes { given: first.given & 0b111, ..*first };
            if change.changes_to(tool).is_some() {
                if self.machine == Machine::Mill {
                    to.begins_at(&self.whole(&first), first.given);
                }
            } else if work.is_some() && work != self.state.work {
                // the numbers of the position in the work offset before have no meaning in the new one
                self.at = self.target(&first);
            }
        }
        self.mode = change.feed_mode.unwrap_or(FeedMode::PerMinute);
        self.feed = change.feed;
        Ok(())
    }

    pub(super) fn work(&mut self, work: f64, to: &mut impl Intent) {
        self.work_is(self.expectation.work_of(work), to);
    }

    /// Sets the work offset by its code. A new work offset begins a new coordinate frame.
    pub(super) fn work_is(&mut self, work: Option<f64>, to: &mut impl Intent) {
        if std::mem::replace(&mut self.state.work, work) != work {
            self.changed(false, to);
        }
    }

    fn changed(&self, tool: bool, to: &mut impl Intent) {
        to.changed(Frame { tool: self.state.tool, work: self.state.work }, self.state.length, tool);
    }

    /// Handles text that is copied into the program unchanged. The codes in the text change the job's state in the same
    /// way as the program's state.
    fn text(&mut self, text: &str, to: &mut impl Intent) -> Done {
        let mut axes = false;
        for token in tokens(text.as_bytes()) {
            let Kind::Word(letter, number) = token.kind else { continue };
            axes |= b"XYZABCUVW".contains(&letter);
            let code = (number.value * 10.0).round();
            if !matches!(letter, b'G' | b'M') || !(0.0..=9999.0).contains(&code) {
                if letter == b'S' {
                    self.state.speed = Some(number.value);
                }
                continue;
            }
            let code = crate::control::Code { letter, tenths: code as u16 };
            let Some(row) = self.control.row(code) else { continue };
            match (row.meaning, row.meaning.group()) {
                (Meaning::StopProgram | Meaning::Pallet, _) => to.stop(StopKind::Program),
                (Meaning::StopOptional, _) => to.stop(StopKind::Optional),
                (Meaning::Dwell, _) => to.wait(f64::NAN),
                (meaning, _) if meaning.turns_spindle() || meaning.cools() => {
                    self.state.rotation = rotation_of(meaning).or(self.state.rotation);
                    if let Some(kind) = coolant_of(meaning) {
                        self.state.coolant = Some(self.state.coolant.unwrap_or_default().then(kind));
                    }
                }
                (_, Some(Group::Motion | Group::Distance | Group::Work | Group::Length | Group::Compensation)) => {
                    axes = true;
                }
                _ => {}
            }
        }
        if axes { unproven(Unmodelled::Text) } else { Ok(()) }
    }

    /// Sets whether the speed is a surface speed or in revolutions per minute. After a change between these two kinds
    /// of speed, the speed is unknown.
    fn counts_speed(&mut self, at_surface: bool) {
        if at_surface != self.css {
            self.state.speed = None;
        }
        (self.css, self.state.css) = (at_surface, at_surface);
    }

    fn spindle(&mut self, spindle: &Spindle) {
        // for a torch or a laser, the form defines M3, M4 and M5; S is the power of a laser
        if let Some(beam) = self.expectation.beam {
            if beam == Beam::Laser {
                self.state.speed = spindle.speed.or(self.state.speed);
            }
            return;
        }
        self.counts_speed(spindle.css.unwrap_or(self.css));
        self.state.limit = spindle.max.or(self.state.limit);
        if let Some(turn) = spindle.turn {
            self.state.rotation = Some(rotation(turn));
        }
        self.state.speed = spindle.speed.or(self.state.speed);
        self.by &= !by::CUTS;
    }

    /// Converts a position of the job. The job of a lathe gives positions as Z and radius.
    pub(super) fn place(&self, to: &Axes) -> Axes {
        if !self.is_lathe() {
            return *to;
        }
        let [z, x, y, a, b, c] = to.values;
        let moved = (to.given & 0b001) << 2 | (to.given & 0b010) >> 1 | (to.given & 0b100) >> 1;
        Axes { values: [x, y, z, a, b, c], given: to.given & !0b111 | moved }
    }

    /// Axes whose position is not given yet.
    fn unknown(&self) -> u8 {
        !self.at.given
            & match self.machine {
                Machine::Mill => 0b111,
                Machine::Lathe => 0b101,
                Machine::Edm => 0b011,
            }
    }

    pub(super) fn target(&self, to: &Axes) -> Axes {
        let to = self.place(to);
        let mut target = self.at;
        for axis in 0..6 {
            if let Some(value) = to.get(axis) {
                target.set(axis, value);
            }
        }
        target
    }

    /// A position in the data type (`Place`) in which positions of job and program are compared.
    pub(super) fn whole(&self, at: &Axes) -> Place {
        let [x, y, u, v, ..] = at.values;
        let guide = |axis: usize, value: f64| if at.given & 1 << axis == 0 { UNSAID } else { value };
        if self.machine == Machine::Edm {
            return [x, y, 0.0, 0.0, 0.0, 0.0, guide(2, u), guide(3, v)];
        }
        place(&at.values)
    }

    pub(super) fn rapid_to(&self, to: &Axes, spin: Option<Spin>) -> Rapid {
        Rapid { to: self.whole(to), unknown: self.unknown(), kept: 0, spin }
    }

    pub(super) fn cut(&self, what: What) -> Cut {
        Cut {
            from: self.whole(&self.at),
            unknown: self.unknown(),
            home: 0,
            open: 0,
            what,
            feed: self.feed,
            mode: self.mode,
            lead: None,
            state: self.state.clone(),
            by: [self.by | self.cuts_by, self.by & !by::CUTS | self.cuts_by],
            by_cycle: false,
            line: 0,
        }
    }

    #[inline]
    fn line_to(&mut self, target: Axes, to: &mut impl Intent) -> Done {
        let [start, end] = [&self.at, &target].map(|at| self.whole(at));
        let line = Straight { from: &start, to: &end, feed: self.feed, mode: self.mode, state: &self.state };
        if self.unknown() == 0 && to.goes_on(&line) {
            self.at = target;
            return Ok(());
        }
        self.cut_to(target, What::Line { to: end }, to)
    }

    fn cut_to(&mut self, target: Axes, what: What, to: &mut impl Intent) -> Done {
        let cut = self.cut(what);
        self.at = target;
        if what.end() == cut.from && !matches!(what, What::Arc(_)) {
            return Ok(()); // no length
        }
        to.cut(&cut, None)
    }

    fn compensated(&mut self, to: &Axes, side: Option<Side>, rapid: bool, intent: &mut impl Intent) -> Done {
        let target = self.target(to);
        self.state.side = Some(side);
        self.state.diameter = self.diameter.filter(|_| side.is_some());
        self.compensation = side.is_some();
        let on = side.map(|side| Compensated { side, register: self.diameter });
        if rapid {
            let cut = self.cut(What::Line { to: self.whole(&target) });
            self.at = target;
            intent.compensation(on);
            return intent.rapid_or_feed(&cut);
        }
        // the rapids before the move are made without the new compensation
        self.cut_to(target, What::Line { to: self.whole(&target) }, intent)?;
        intent.compensation(on);
        Ok(())
    }

    fn arc(&mut self, arc: &Arc, to: &mut impl Intent) -> Done {
        let target = self.target(&arc.to);
        if self.machine == Machine::Edm && target.given & 0b1100 != 0 {
            return unproven(Unmodelled::SlantedArc);
        }
        let from = self.at.values;
        let plane = if self.is_lathe() { Plane::Xz } else { arc.plane };
        let [first, second, _] = crate::nc::axes_of(plane);
        let mut center = [from[0], from[1], from[2]];
        match (arc.center, arc.radius) {
            (Some(at), _) => {
                let at = self.place(&at);
                for axis in [first, second] {
                    center[axis] = at.get(axis).unwrap_or(from[axis]);
                }
            }
            (None, Some(radius)) => {
                let half = [(target.values[first] - from[first]) / 2.0, (target.values[second] - from[second]) / 2.0];
                let chord = half[0].hypot(half[1]);
                let height = (radius * radius - chord * chord).max(0.0).sqrt();
                let left = (arc.direction == Direction::Ccw) == (radius > 0.0);
                let side = if left { 1.0 } else { -1.0 };
                center[first] = from[first] + half[0] - side * height * half[1] / chord;
                center[second] = from[second] + half[1] + side * height * half[0] / chord;
            }
            (None, None) => return unproven(Unmodelled::ArcWithout),
        }
        let direction = arc.direction;
        let turn = Turn {
            to: target.values,
            center,
            plane,
            direction,
            turns: arc.turns,
            feed: self.feed.unwrap_or(0.0),
            machine: 0,
        };
        self.cut_to(target, What::Arc(turn), to)
    }

    /// Handles an action of the wire EDM machine: threading or cutting the wire, drilling the start hole, filling the
    /// tank. The form's sequence for the action defines the codes.
    fn wire(&mut self, action: EdmAction, to: &mut impl Intent) -> Done {
        if self.expectation.wire.is_none() {
            return unproven(Unmodelled::Wire);
        }
        self.expectation.wire_codes(action).for_each(|code| to.wire(code));
        Ok(())
    }
}

/// Passes a dwell on if its time is not zero.
pub(super) fn wait(seconds: f64, to: &mut impl Intent) {
    if seconds > 0.0 {
        to.wait(seconds);
    }
}

pub(super) fn rotation(turn: SpindleTurn) -> Rotation {
    match turn {
        SpindleTurn::Cw => Rotation::Cw,
        SpindleTurn::Ccw => Rotation::Ccw,
        SpindleTurn::Off => Rotation::Stop,
    }
}

/// The turret station and the offset register of a lathe's tool, as in the T word. The last two digits of the T word
/// are the register.
fn turret(tool: &Tool, register: Option<f64>) -> [Option<f64>; 2] {
    const STATIONS: f64 = 100.0;
    let whole = tool.number >= STATIONS;
    match tool.length_offset {
        None if whole => [Some((tool.number / STATIONS).trunc()), Some(tool.number % STATIONS)],
        own if whole => [Some((tool.number / STATIONS).trunc()), own.map(|own| own % STATIONS)],
        own => [Some(tool.number), own.or(register).or(Some(tool.number))],
    }
}
