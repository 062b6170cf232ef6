//! The job's side: events as intended cuts and ways.

use super::comparer::Intent;
use super::cut::{Cut, DEPTH, Place, Rapid, State, What};
use crate::control;
use crate::cycle::{Defaults, Plan, Step, Steps, check, plan};
use crate::diag::{Code, Diag};
use crate::lang::{Machine, UnitChoice, work_code};
use crate::nc::{Rotation, Turn};
use crate::render::cycle_defaults;
use crate::sema::Settings;
use crate::toolpath::{
    Arc, Axes, CycleKind, CycleSpec, Direction, Event, FeedMode, Hole, Order, Plane, Side, Spindle, SpindleTurn, Start,
    StopKind, ToolChange, Units, impossible,
};

/// What the form says of the job's numbers.
#[derive(Clone, Copy, Debug)]
pub struct Expectation {
    /// Cycle defaults in inches and in millimetres.
    pub defaults: [Defaults; 2],
    /// How far short lines may leave an arc, in inches and in millimetres.
    pub chord: [f64; 2],
    /// Code of the first work offset: 54.
    pub first_work: f64,
    /// Work offset that holds before the job names one.
    pub work: Option<f64>,
    /// What a tool's number is raised by for its length and diameter registers, where the job names none.
    pub registers: Option<[f64; 2]>,
    /// The machine loads tools (M6) and has length offsets.
    pub tools: bool,
    /// Only the program says its units.
    pub units_due: bool,
}

impl Default for Expectation {
    /// What holds without a form: nothing is filled in.
    fn default() -> Self {
        let defaults = Defaults { rigid: true, ..Defaults::default() };
        Expectation {
            defaults: [defaults; 2],
            chord: [0.001, 0.02],
            first_work: 54.0,
            work: None,
            registers: None,
            tools: true,
            units_due: true,
        }
    }
}

impl Expectation {
    /// What a form fills in.
    pub fn of_form(settings: &Settings, sink_as_printed: bool) -> Expectation {
        let defaults = [Units::Inch, Units::Mm]
            .map(|units| Defaults { rigid: true, ..cycle_defaults(settings, units, sink_as_printed) });
        let chord = settings.tolerance * if settings.units == UnitChoice::Mm { 1.0 / 25.4 } else { 1.0 };
        Expectation {
            defaults,
            chord: [chord.max(0.001), (chord * 25.4).max(0.02)],
            first_work: settings.work,
            work: Some(settings.work_default),
            registers: Some([settings.lcomp, settings.dcomp]),
            tools: !settings.control().refuses(control::Code::m(6)),
            units_due: settings.units == UnitChoice::Both,
        }
    }
}

/// What a hole must be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expected {
    /// Over the hole.
    pub at: Place,
    /// Where the feed begins.
    pub plane: f64,
    pub bottom: f64,
    pub dwell: Option<f64>,
    /// Its pecks may be others.
    pub pecks: bool,
    /// Between pecks the tool comes out of the hole.
    pub retracts: bool,
    /// A tap: feed and speed are its pitch.
    pub is_tap: bool,
}

/// An open cycle.
struct Open {
    spec: CycleSpec,
    point: Option<f64>,
    first_return: Option<f64>,
}

/// Where the job stands.
pub(super) struct Job {
    expectation: Expectation,
    order: Order,
    pub units: Option<Units>,
    at: Axes,
    feed: Option<f64>,
    mode: FeedMode,
    pub state: State,
    css: bool,
    cycle: Option<Open>,
    diameter: Option<f64>,
    steps: Steps,
    compensation: bool,
}

impl Job {
    pub fn new(expectation: Expectation) -> Job {
        Job {
            expectation,
            order: Order::default(),
            units: None,
            at: Axes::default(),
            feed: None,
            mode: FeedMode::PerMinute,
            state: State { side: Some(None), ..State::default() },
            css: false,
            cycle: None,
            diameter: None,
            steps: Steps::default(),
            compensation: false,
        }
    }

    /// Takes an event and hands its motions on.
    ///
    /// # Errors
    /// What can't be proven; what the intent found.
    pub fn event(&mut self, event: Event<'_>, to: &mut impl Intent) -> Result<(), Box<Diag>> {
        self.order.follow(&event)?;
        match event {
            Event::Start(start) => self.start(start, to),
            Event::ToolChange(change) => self.tool_change(change, to),
            Event::Rapid(target) => {
                let target = self.target(&target);
                self.at = target;
                to.rapid(self.rapid_to(target.values, None))
            }
            Event::Line { to: target, feed } => {
                self.feed = feed.or(self.feed);
                let target = self.target(&target);
                let what = What::Line { to: target.values };
                self.cut_to(target, what, to)
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
                self.cycle = Some(Open { spec: spec.clone(), point: None, first_return: None });
                check(spec).map_err(Box::<Diag>::from)
            }
            Event::Hole(hole) => self.hole(&hole, to),
            Event::CycleEnd => {
                self.cycle = None;
                Ok(())
            }
            Event::Dwell(seconds) => self.dwell(seconds, None, to),
            Event::Stop(kind) => {
                to.stop(kind);
                Ok(())
            }
            Event::Feed(feed) => {
                self.feed = Some(feed);
                Ok(())
            }
            Event::Work(work) => {
                let before = self.state.work;
                self.work(work);
                if self.state.work != before {
                    to.lost(false);
                }
                Ok(())
            }
            Event::Spindle(spindle) => {
                self.spindle(&spindle);
                Ok(())
            }
            Event::Tilt(_) => unproven("the tool axis changes"),
            Event::SubStart(_) | Event::SubCall(_) => unproven("the job has subprograms"),
            Event::Thread(_) => unproven("the job cuts a thread on a lathe"),
            Event::Edm(_) => unproven("the job is for wire EDM"),
            Event::Text(_)
            | Event::Begin(_)
            | Event::End(_)
            | Event::Comment(_)
            | Event::Coolant(_)
            | Event::Set(..)
            | Event::SubEnd => Ok(()),
            Event::Finish => to.finish(),
        }
    }

    fn start(&mut self, start: &Start, to: &mut impl Intent) -> Result<(), Box<Diag>> {
        if start.machine != Machine::Mill {
            return unproven("the job is for a lathe or wire EDM machine");
        }
        self.units = Some(start.units);
        self.state.work = self.expectation.work;
        to.units(start.units, self.expectation.chord[usize::from(start.units == Units::Mm)]);
        Ok(())
    }

    fn tool_change(&mut self, change: &ToolChange, to: &mut impl Intent) -> Result<(), Box<Diag>> {
        if let Some(tool) = change.tool.as_ref().filter(|tool| self.state.tool != Some(tool.number)) {
            self.state.tool = Some(tool.number);
            let [length, diameter] =
                self.expectation.registers.map_or([None; 2], |by| by.map(|by| Some(tool.number + by)));
            self.state.length = tool.length_offset.or(length).filter(|_| self.expectation.tools);
            self.diameter = tool.diameter_offset.or(diameter);
            (self.state.speed, self.state.rotation) = (None, None);
            self.at = Axes { given: self.at.given & !0b111, ..self.at };
            to.lost(true);
        }
        if let Some(spindle) = &change.spindle {
            self.spindle(spindle);
        }
        if let Some(work) = change.work {
            let before = self.state.work;
            self.work(work);
            if self.state.work != before {
                to.lost(false);
            }
        }
        self.mode = change.feed_mode.unwrap_or(FeedMode::PerMinute);
        self.feed = change.feed;
        Ok(())
    }

    fn work(&mut self, work: f64) {
        self.state.work = work_code(self.expectation.first_work, work);
    }

    fn spindle(&mut self, spindle: &Spindle) {
        self.css = spindle.css.unwrap_or(self.css);
        self.state.css = self.css;
        if let Some(turn) = spindle.turn {
            self.state.rotation = Some(rotation(turn));
        }
        self.state.speed = spindle.speed.or(self.state.speed).filter(|_| !self.css);
    }

    /// One that does not follow a cut only waits.
    fn dwell(&mut self, seconds: f64, hole: Option<&Expected>, to: &mut impl Intent) -> Result<(), Box<Diag>> {
        if seconds > 0.0 && to.way_is_empty() { to.cut(&self.cut(What::Dwell(seconds)), hole) } else { Ok(()) }
    }

    fn target(&self, to: &Axes) -> Axes {
        let mut target = self.at;
        for axis in 0..6 {
            if let Some(value) = to.get(axis) {
                target.set(axis, value);
            }
        }
        target
    }

    fn rapid_to(&self, to: Place, rotation: Option<Rotation>) -> Rapid {
        Rapid { to, unknown: !self.at.given & 0b111, rotation }
    }

    fn cut(&self, what: What) -> Cut {
        Cut {
            from: self.at.values,
            unknown: !self.at.given & 0b111,
            what,
            feed: if what.feeds() { self.feed } else { None },
            mode: self.mode,
            state: self.state,
            by_cycle: false,
            line: 0,
        }
    }

    fn cut_to(&mut self, target: Axes, what: What, to: &mut impl Intent) -> Result<(), Box<Diag>> {
        let cut = self.cut(what);
        self.at = target;
        if what.end(&cut.from) == cut.from && !matches!(what, What::Arc(_)) {
            return Ok(()); // no length
        }
        to.cut(&cut, None)
    }

    fn compensated(
        &mut self,
        to: &Axes,
        side: Option<Side>,
        rapid: bool,
        intent: &mut impl Intent,
    ) -> Result<(), Box<Diag>> {
        let target = self.target(to);
        self.state.side = Some(side);
        self.state.diameter = self.diameter.filter(|_| side.is_some());
        self.compensation = side.is_some();
        if rapid {
            let cut = self.cut(What::Line { to: target.values });
            self.at = target;
            return intent.rapid_or_feed(&cut);
        }
        self.cut_to(target, What::Line { to: target.values }, intent)
    }

    fn arc(&mut self, arc: &Arc, to: &mut impl Intent) -> Result<(), Box<Diag>> {
        let target = self.target(&arc.to);
        let from = self.at.values;
        let [first, second, _] = crate::nc::axes_of(arc.plane);
        let mut center = [from[0], from[1], from[2]];
        match (arc.center, arc.radius) {
            (Some(at), _) => {
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
            (None, None) => return unproven("an arc has neither centre nor radius"),
        }
        let (plane, direction): (Plane, Direction) = (arc.plane, arc.direction);
        let turn =
            Turn { to: target.values, center, plane, direction, turns: arc.turns, feed: self.feed.unwrap_or(0.0) };
        self.cut_to(target, What::Arc(turn), to)
    }

    fn hole(&mut self, hole: &Hole, to: &mut impl Intent) -> Result<(), Box<Diag>> {
        let Some(open) = &mut self.cycle else { return impossible("a hole outside a cycle") };
        let defaults = self.expectation.defaults[usize::from(self.units == Some(Units::Mm))];
        let rpm = self.state.speed;
        let mut planes = Plan::of(&open.spec, hole.depth, &defaults, rpm).map_err(Box::<Diag>::from)?;
        if self.mode == FeedMode::PerRev {
            planes.lead = Some(planes.feed);
        }
        let Some(point) = hole.at.get(DEPTH).or(open.point) else { return unproven("a hole has no height") };
        open.point = Some(point);
        let clear = point + planes.clear;
        let first = *open.first_return.get_or_insert(point + open.spec.return_height.unwrap_or(planes.clear));
        let return_plane = first.max(clear);
        let kind = open.spec.kind;
        let mode = open.spec.mode;
        let custom = matches!(kind, CycleKind::Custom1 | CycleKind::Custom2 | CycleKind::Custom3);
        let mut steps = std::mem::take(&mut self.steps);
        if custom {
            return unproven("what a custom cycle does, only its form knows");
        }
        plan(&open.spec, &planes, return_plane - point, &defaults, &mut steps).map_err(Box::<Diag>::from)?;
        let pecks =
            matches!(kind, CycleKind::Deep | CycleKind::Chipbreak) || (kind.is_tap() && open.spec.mode.is_some());
        let mut target = self.target(&hole.at);
        target.set(DEPTH, return_plane);
        let plane = steps.list.iter().take_while(|step| matches!(step, Step::Rapid(_))).last();
        let plane = if let Some(Step::Rapid(height)) = plane { point + height } else { clear };
        let expected = Expected {
            at: target.values,
            plane,
            bottom: point + planes.bottom,
            dwell: planes.dwell,
            pecks,
            retracts: kind == CycleKind::Deep || mode == Some(CycleKind::Deep),
            is_tap: kind.is_tap(),
        };
        let list = std::mem::take(&mut steps.list);
        let before = self.state;
        if let (Some(inwards), Some(Rotation::Cw | Rotation::Ccw)) = (kind.inwards(), before.rotation) {
            self.state.rotation = Some(rotation(inwards)); // whatever the spindle does else
        }
        let done = self.steps(&list, point, target, &expected, to);
        self.state = before;
        steps.list = list;
        self.steps = steps;
        done
    }

    fn steps(
        &mut self,
        steps: &[Step],
        point: f64,
        target: Axes,
        hole: &Expected,
        to: &mut impl Intent,
    ) -> Result<(), Box<Diag>> {
        let (feed, state) = (self.feed, self.state);
        self.at = target;
        to.rapid(self.rapid_to(target.values, None))?;
        to.hole_begins(hole);
        for step in steps {
            let mut at = target;
            match *step {
                Step::Rapid(height) => {
                    at.set(DEPTH, point + height);
                    self.at = at;
                    to.rapid(self.rapid_to(at.values, self.state.rotation))?;
                }
                Step::RapidAside(height, x, y) => {
                    at.set(DEPTH, point + height);
                    at.values[0] += x;
                    at.values[1] += y;
                    self.at = at;
                    to.rapid(self.rapid_to(at.values, self.state.rotation))?;
                }
                Step::Feed(height, feed) => {
                    at.set(DEPTH, point + height);
                    self.feed = Some(feed);
                    let cut = self.cut(What::Line { to: at.values });
                    self.at = at;
                    if cut.from != at.values {
                        to.cut(&cut, Some(hole))?;
                    }
                }
                Step::Dwell(seconds) => self.dwell(seconds, Some(hole), to)?,
                Step::SpindleStop | Step::Orient(_) => {
                    self.state.rotation = self.state.rotation.map(|_| Rotation::Stop);
                }
                Step::SpindleStart => self.state = State { tool: self.state.tool, ..state },
                Step::SpindleReverse(ratio) => {
                    self.state.rotation = self.state.rotation.map(Rotation::reversed);
                    self.state.speed = self.state.speed.map(|speed| speed * ratio);
                }
                Step::ProgramStop => to.stop(StopKind::Program),
            }
        }
        (self.feed, self.state) = (feed, state);
        to.hole_ends(hole)
    }
}

/// Something whose motions are not known well enough to prove them.
fn unproven<T>(what: &str) -> Result<T, Box<Diag>> {
    let message = format!("{what}: its motions can't be proven");
    Err(Box::new(Diag::new(Code::PV020, message).help("verify proves milling programs without subprograms")))
}

fn rotation(turn: SpindleTurn) -> Rotation {
    match turn {
        SpindleTurn::Cw => Rotation::Cw,
        SpindleTurn::Ccw => Rotation::Ccw,
        SpindleTurn::Off => Rotation::Stop,
    }
}
