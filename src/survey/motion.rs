//! Measures moves: extents, lengths and times.

use super::totals::Totals;
use crate::cycle::{Defaults, Plan, Step, Steps, plan, thread_passes};
use crate::lang::Machine;
use crate::times::{Curve, Planner, Rates, Way};
use crate::toolpath::{
    Arc, Axes, CycleSpec, Direction, Event, FeedMode, Hole, JobAxes, PlaneArc, Spindle, Thread, ToolChange, Units,
};

/// The current position of the tool, feed and spindle, from which moves are measured.
#[derive(Debug)]
pub struct Motion {
    defaults: Defaults,
    machine: Machine,
    at: Axes,
    feed: Option<f64>,
    mode: FeedMode,
    spindle: Spindle,
    cycle: Option<CycleSpec>,
    /// Height of the last point of the cycle.
    point: Option<f64>,
    /// The height to which the cycle returns: the return height of the cycle above its first point.
    return_plane: Option<f64>,
    steps: Steps,
    /// The parts of an arc between its quadrant points.
    parts: Vec<f64>,
    /// Calculates times with the accelerations of the axes, if the machine is known.
    planner: Option<Planner>,
    /// The units of the job.
    units: Units,
}

impl Motion {
    /// Begins at an unknown position. `rates`: the speeds of the machine, if they are known.
    pub fn new(defaults: Defaults, machine: Machine, units: Units, rates: Option<&Rates>) -> Motion {
        Motion {
            // a rigid tap moves in and out at its feed, in a cycle or in single moves
            defaults: Defaults { rigid: true, ..defaults },
            machine,
            at: Axes::default(),
            feed: None,
            mode: FeedMode::PerMinute,
            spindle: Spindle::default(),
            cycle: None,
            point: None,
            return_plane: None,
            steps: Steps::default(),
            parts: Vec::new(),
            planner: rates.cloned().map(Planner::new),
            units,
        }
    }

    /// Stops the axes, and adds the time of the cuts up to here.
    pub fn stop(&mut self, sums: &mut Totals) {
        if let Some(planner) = &mut self.planner {
            sums.cut(0.0, Some(planner.take().cutting / 60.0));
        }
    }

    /// The position becomes unknown.
    pub fn forget_place(&mut self) {
        self.at = Axes::default();
    }

    /// Begins a subprogram. In a subprogram, only the values that the subprogram sets itself are known.
    pub fn begin_subprogram(&mut self) {
        self.forget_place();
        self.spindle = Spindle::default();
        (self.feed, self.mode) = (None, FeedMode::PerMinute);
    }

    /// Begins an operation. `fresh`: the operation has another tool than the one before.
    pub fn operation(&mut self, change: &ToolChange, fresh: bool) {
        if fresh {
            self.spindle = Spindle::default();
        }
        self.turn(change.spindle.unwrap_or_default().of_operation());
        self.feed = change.feed;
        self.mode = change.feed_mode.unwrap_or(FeedMode::PerMinute);
    }

    fn turn(&mut self, spindle: Spindle) {
        self.spindle = spindle.after(self.spindle);
    }

    /// The state of the spindle, as the job has set it so far.
    pub fn spindle(&self) -> Spindle {
        self.spindle
    }

    /// Spindle revolutions per minute, if they do not depend on the position.
    fn rpm(&self) -> Option<f64> {
        self.spindle.rpm(None, self.units)
    }

    /// Spindle revolutions per minute during a cut that begins at `from`. At a constant surface speed, the revolutions at
    /// the middle of the cut are used. For a straight cut, the speed at the middle gives the exact time.
    fn rpm_from(&self, from: &Axes) -> Option<f64> {
        let radius = from.get(1).zip(self.at.get(1)).map(|(from, to)| (from + to).abs() / 2.0);
        self.spindle.rpm(radius, self.units)
    }

    /// Adds the moves of an event.
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
            Event::Spindle(spindle) => self.turn(*spindle),
            _ => {}
        }
    }

    /// Moves to a position. Axes without a value in `to` do not move.
    fn go(&mut self, to: &Axes) {
        for axis in 0..6 {
            if let Some(value) = to.get(axis) {
                self.at.set(axis, value);
            }
        }
    }

    fn rapid(&mut self, to: &Axes, sums: &mut Totals) {
        let from = self.at;
        self.go(to);
        if self.planner.is_some() {
            let way = self.way(&from);
            self.plan(|planner| planner.rapid(&way));
        }
        sums.moves.moves_to(&self.at);
    }

    fn plan(&mut self, plan: impl FnOnce(&mut Planner)) {
        if let Some(planner) = &mut self.planner {
            plan(planner);
        }
    }

    /// The travel from `from`, in millimetres and degrees. The travel is 0 for an axis of which one position is
    /// unknown.
    fn way(&self, from: &Axes) -> Way {
        let between = |axis| Some(self.at.get(axis)? - from.get(axis)?);
        let way = |axis| between(axis).map_or(0.0, |way| if axis < 3 { way * self.units.in_mm() } else { way });
        let mut whole = Way::default();
        (0..6).for_each(|axis| whole[self.machine_axis(axis)] = way(axis));
        whole
    }

    /// The machine axis that belongs to an axis of the job: in a job for a lathe, the first axis is Z and the second is the radius.
    fn machine_axis(&self, axis: usize) -> usize {
        match (self.machine == Machine::Lathe, axis) {
            (true, 0) => 2,
            (true, 1) => 0,
            (true, 2) => 1,
            _ => axis,
        }
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
        self.feed = feed.or(self.feed);
        let way = self.way(&from);
        self.cut((&from, square.sqrt()), self.feed, sums, |planner, feed| planner.cut(&way, feed));
    }

    /// Adds a cut of this length that begins at `from`. `plan` is called with the feed of the cut in millimetres per second.
    fn cut(
        &mut self,
        (from, length): (&Axes, f64),
        feed: Option<f64>,
        sums: &mut Totals,
        plan: impl FnOnce(&mut Planner, f64),
    ) {
        let minutes = feed.and_then(|feed| self.minutes(length, feed, from));
        match (&mut self.planner, minutes) {
            (Some(planner), Some(minutes)) if length > 0.0 => {
                plan(planner, length * self.units.in_mm() / (minutes * 60.0));
                sums.cut(length, Some(0.0));
            }
            _ => sums.cut(length, minutes),
        }
    }

    /// The time of a cut in minutes, if it is known.
    fn minutes(&self, length: f64, feed: f64, from: &Axes) -> Option<f64> {
        self.mode.minutes(length, feed, self.rpm_from(from))
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
            // printing the job reports the error
            return sums.cuts.moves_to(&self.at);
        };
        let mut parts = std::mem::take(&mut self.parts);
        parts.clear();
        // after a full turn, the quadrant points are the same again
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
        self.feed = feed.or(self.feed);
        let mut way = self.way(&from);
        let plane = [a, b].map(|axis| self.machine_axis(axis));
        plane.iter().for_each(|&axis| way[axis] = 0.0);
        let begin = [a, b].map(|axis| from.values[axis]);
        let offset = [0, 1].map(|axis| (begin[axis] - curve.centre[axis]) * self.units.in_mm());
        let planned = Curve { plane, from: offset, sweep: curve.sweep, rise: way };
        self.cut((&from, (curve.radius * curve.sweep).hypot(rise)), self.feed, sums, |planner, feed| {
            planner.arc(&planned, feed)
        });
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
        self.rapid(&hole.at, &mut Totals::default());
        sums.moves.moves_to(&self.at);
        // the axis along which the hole is drilled
        let Some(depth_axis) = JobAxes::of(self.machine).depth else { return };
        // a point without a height is at the height of the point before it
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
            // the moves of this cycle are known only to the form
            sums.cut(0.0, None);
            for height in [0.0, planes.bottom] {
                sums.cuts.to(depth_axis, point + height);
                sums.moves.to(depth_axis, point + height);
            }
            return;
        }
        let mut height = top;
        let steps = std::mem::take(&mut self.steps.list);
        let from = self.at;
        for step in &steps {
            let along = |to: f64| {
                let mut way = Way::default();
                way[self.machine_axis(depth_axis)] = (to - height) * self.units.in_mm();
                way
            };
            match *step {
                Step::Rapid(to) | Step::RapidAside(to, ..) => {
                    let way = along(to);
                    self.plan(|planner| planner.rapid(&way));
                    height = to;
                }
                Step::Feed(to, feed) => {
                    let way = along(to);
                    for reached in [height, to] {
                        sums.cuts.to(depth_axis, point + reached);
                        sums.moves.to(depth_axis, point + reached);
                    }
                    let length = (to - height).abs();
                    self.cut((&from, length), Some(feed), sums, |planner, feed| planner.cut(&way, feed));
                    height = to;
                }
                _ => self.plan(Planner::stop),
            }
        }
        self.steps.list = steps;
    }
}
