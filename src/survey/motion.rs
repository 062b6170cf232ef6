//! Moves measured: how far they reach, how long they are, how much time they take.

use super::totals::Totals;
use crate::cycle::{Defaults, Plan, Step, Steps, plan, thread_passes};
use crate::lang::Machine;
use crate::toolpath::{Arc, Axes, CycleSpec, Direction, Event, FeedMode, Hole, PlaneArc, Spindle, Thread, ToolChange};

/// Where the tool is, and how fast it cuts.
#[derive(Debug)]
pub struct Motion {
    defaults: Defaults,
    /// The axis along which the tool goes into a hole.
    depth: usize,
    at: Axes,
    feed: Option<f64>,
    mode: FeedMode,
    spindle: Spindle,
    cycle: Option<CycleSpec>,
    /// Height of the cycle's last point.
    point: Option<f64>,
    /// Where the cycle returns to, counted from its first point.
    return_plane: Option<f64>,
    steps: Steps,
    /// Quarters of an arc.
    parts: Vec<f64>,
}

impl Motion {
    /// At an unknown place.
    pub fn new(defaults: Defaults, machine: Machine) -> Motion {
        Motion {
            // a rigid tap goes in and out at its feed, whoever makes it
            defaults: Defaults { rigid: true, ..defaults },
            depth: if machine == Machine::Lathe { 0 } else { 2 },
            at: Axes::default(),
            feed: None,
            mode: FeedMode::PerMinute,
            spindle: Spindle::default(),
            cycle: None,
            point: None,
            return_plane: None,
            steps: Steps::default(),
            parts: Vec::new(),
        }
    }

    /// Nobody knows where the tool is.
    pub fn forget_place(&mut self) {
        self.at = Axes::default();
    }

    /// In a subprogram nothing is known but what it says itself.
    pub fn begin_subprogram(&mut self) {
        self.forget_place();
        self.spindle = Spindle::default();
        (self.feed, self.mode) = (None, FeedMode::PerMinute);
    }

    /// An operation begins; `fresh`: with another tool.
    pub fn operation(&mut self, change: &ToolChange, fresh: bool) {
        if fresh {
            self.spindle = Spindle::default();
        }
        self.turn(change.spindle);
        self.feed = change.feed;
        self.mode = change.feed_mode.unwrap_or(FeedMode::PerMinute);
    }

    fn turn(&mut self, spindle: Option<Spindle>) {
        let Some(new) = spindle else { return };
        let own = &mut self.spindle;
        *own = Spindle {
            speed: new.speed.or(own.speed),
            turn: new.turn.or(own.turn),
            css: new.css.or(own.css),
            max: new.max.or(own.max),
        };
    }

    /// The spindle, as far as the job has said it.
    pub fn spindle(&self) -> Spindle {
        self.spindle
    }

    /// Turns of the spindle in a minute, where they are known.
    fn rpm(&self) -> Option<f64> {
        self.spindle.speed.filter(|_| self.spindle.css != Some(true))
    }

    /// Adds what an event does.
    pub fn event(&mut self, event: &Event<'_>, sums: &mut Totals) {
        match event {
            Event::Rapid(to) => self.rapid(to, sums),
            Event::Line { to, feed } => self.line(to, *feed, sums),
            Event::Infeed { infeed, feed } => match infeed.rapid {
                true => self.rapid(&infeed.to, sums),
                false => self.line(&infeed.to, *feed, sums),
            },
            Event::Outfeed { to, feed, rapid } => match rapid {
                true => self.rapid(to, sums),
                false => self.line(to, *feed, sums),
            },
            Event::Arc { arc, feed } => self.arc(arc, *feed, sums),
            Event::Thread(thread) => self.thread(thread, sums),
            Event::CycleBegin(spec) => {
                self.cycle = Some((*spec).clone());
                (self.point, self.return_plane) = (None, None);
            }
            Event::Hole(hole) => self.hole(hole, sums),
            Event::Feed(feed) => self.feed = Some(*feed),
            Event::Spindle(spindle) => self.turn(Some(*spindle)),
            _ => {}
        }
    }

    /// Goes somewhere; what the move does not say stays.
    fn go(&mut self, to: &Axes) {
        for axis in 0..6 {
            if let Some(value) = to.get(axis) {
                self.at.set(axis, value);
            }
        }
    }

    fn rapid(&mut self, to: &Axes, sums: &mut Totals) {
        self.go(to);
        sums.moves.moves_to(&self.at);
    }

    fn line(&mut self, to: &Axes, feed: Option<f64>, sums: &mut Totals) {
        let from = self.at;
        self.go(to);
        let between = |axis| Some(self.at.get(axis)? - from.get(axis)?);
        let square: f64 = (0..3).filter_map(between).map(|distance| distance * distance).sum();
        for place in [&from, &self.at] {
            sums.cuts.moves_to(place);
            sums.moves.moves_to(place);
        }
        self.cut(square.sqrt(), feed, sums);
    }

    /// A cut of this length.
    fn cut(&mut self, length: f64, feed: Option<f64>, sums: &mut Totals) {
        self.feed = feed.or(self.feed);
        sums.cut(length, self.feed.and_then(|feed| self.minutes(length, feed)));
    }

    /// The time of a cut, if it is known.
    fn minutes(&self, length: f64, feed: f64) -> Option<f64> {
        let minutes = match self.mode {
            FeedMode::InverseTime => 1.0 / feed,
            _ if length == 0.0 => 0.0,
            FeedMode::PerMinute => length / feed,
            FeedMode::PerRev => length / (feed * self.rpm()?),
        };
        Some(minutes).filter(|minutes| minutes.is_finite())
    }

    fn arc(&mut self, arc: &Arc, feed: Option<f64>, sums: &mut Totals) {
        let ([a, b], across) = arc.plane.axes();
        let from = self.at;
        self.go(&arc.to);
        let point = |place: &Axes| Some([place.get(a)?, place.get(b)?]);
        let ccw = arc.direction == Direction::Ccw;
        let curve = || {
            let (from, to) = (point(&from)?, point(&self.at)?);
            let centre = match (&arc.center, arc.radius) {
                (Some(centre), _) => point(centre)?,
                (None, radius) => PlaneArc::centre_by_radius(from, to, radius?, ccw)?,
            };
            Some(PlaneArc::new(from, to, centre, ccw, arc.turns))
        };
        let Some(curve) = curve() else {
            // printing it says what is wrong
            return sums.cuts.moves_to(&self.at);
        };
        let mut parts = std::mem::take(&mut self.parts);
        parts.clear();
        // after a whole turn the quarters are the same ones again
        let turn = PlaneArc { sweep: curve.sweep.clamp(-std::f64::consts::TAU, std::f64::consts::TAU), ..curve };
        turn.quadrant_parts(&mut parts);
        for part in &parts {
            let [first, second] = turn.point(*part);
            sums.cuts.to(a, first);
            sums.cuts.to(b, second);
        }
        self.parts = parts;
        for place in [&from, &self.at] {
            sums.cuts.moves_to(place);
        }
        sums.moves.join(&sums.cuts);
        let rise = from.get(across).zip(self.at.get(across)).map_or(0.0, |(from, to)| to - from);
        self.cut((curve.radius * curve.sweep).hypot(rise), feed, sums);
    }

    fn thread(&mut self, thread: &Thread, sums: &mut Totals) {
        for place in [&thread.from, &thread.to] {
            let mut root = *place;
            if let Some(crest) = place.get(1) {
                root.set(1, crest - thread.depth);
            }
            for place in [place, &root] {
                sums.cuts.moves_to(place);
                sums.moves.moves_to(place);
            }
        }
        let square: f64 = (0..2).map(|axis| thread.to.values[axis] - thread.from.values[axis]).map(|d| d * d).sum();
        let count = thread.passes.map(|passes| passes as usize);
        let passes = thread_passes(thread.depth.abs(), thread.first_depth, count, thread.min_depth.unwrap_or_default());
        let length = square.sqrt() * passes.map_or(1.0, |passes| passes.len() as f64);
        let minutes = self.rpm().map(|rpm| length / (thread.pitch * rpm)).filter(|minutes| minutes.is_finite());
        sums.cut(length, minutes);
        self.go(&thread.from);
    }

    fn hole(&mut self, hole: &Hole, sums: &mut Totals) {
        sums.holes += 1;
        self.go(&hole.at);
        sums.moves.moves_to(&self.at);
        let depth_axis = self.depth;
        // a point without its height is as high as the one before it
        let (Some(spec), Some(point)) = (&self.cycle, hole.at.get(depth_axis).or(self.point)) else { return };
        self.point = Some(point);
        let Ok(planes) = Plan::of(spec, hole.depth, &self.defaults, self.rpm()) else { return };
        let returns = spec.return_height.map(|height| *self.return_plane.get_or_insert(point + height));
        let top = returns.map_or(planes.clear, |plane| (plane - point).max(planes.clear));
        let planned = plan(spec, &planes, top, &self.defaults, &mut self.steps);
        for axis in (0..3).filter(|&axis| axis != depth_axis) {
            if let Some(value) = self.at.get(axis) {
                sums.cuts.to(axis, value);
            }
        }
        sums.moves.to(depth_axis, point + top);
        self.at.set(depth_axis, point + top);
        if planned.is_err() {
            // a cycle that only the form knows
            sums.cut(0.0, None);
            for height in [0.0, planes.bottom] {
                sums.cuts.to(depth_axis, point + height);
                sums.moves.to(depth_axis, point + height);
            }
            return;
        }
        let mut height = top;
        for step in &self.steps.list {
            match *step {
                Step::Rapid(to) | Step::RapidAside(to, ..) => height = to,
                Step::Feed(to, feed) => {
                    for reached in [height, to] {
                        sums.cuts.to(depth_axis, point + reached);
                        sums.moves.to(depth_axis, point + reached);
                    }
                    let length = (to - height).abs();
                    sums.cut(length, self.minutes(length, feed));
                    height = to;
                }
                _ => {}
            }
        }
    }
}
