//! Plans the holes of the job as the steps of its cycles.

use super::cut::{DEPTH, Spin, What};
use super::expectation::taps_ahead;
use super::intended::{Job, rotation, wait};
use super::intent::{Done, Expected, Intent, unproven};
use super::tables::Unmodelled;
use crate::cycle::{Plan, Step, plan};
use crate::diag::Diag;
use crate::nc::Rotation;
use crate::toolpath::{Axes, CycleKind, CycleSpec, FeedMode, Hole, StopKind, Units, impossible};

/// A cycle that the job has opened and not yet closed.
pub(super) struct Open {
    pub spec: CycleSpec,
    /// Height of the point of the last hole.
    pub point: Option<f64>,
    pub first_return: Option<f64>,
    /// The last hole.
    pub last: Option<Hole>,
    /// The number of holes made one after the other, up to the last one, that differ from the hole before only in their
    /// position.
    pub alike: u64,
}

impl Open {
    /// The cycle before its first hole.
    pub fn new(spec: CycleSpec) -> Open {
        Open { spec, point: None, first_return: None, last: None, alike: 0 }
    }

    /// Whether a hole differs from the last one only in its position.
    pub fn is_alike(&self, hole: &Hole) -> bool {
        let [height, last] = [Some(hole), self.last.as_ref()]
            .map(|hole| hole.map(|hole| (hole.at.given, hole.at.get(DEPTH), hole.depth)));
        height == last && hole.at.given & !(1 << DEPTH) == 0b11
    }
}

impl Job {
    /// Passes on the motions of one hole of the open cycle.
    pub(super) fn hole(&mut self, hole: &Hole, to: &mut impl Intent) -> Done {
        let Some(open) = &mut self.cycle else { return impossible("a hole outside a cycle") };
        let is_alike = open.is_alike(hole);
        let [x, y, ..] = hole.at.values;
        if is_alike && open.alike > 0 && to.next_hole([x, y]) {
            (self.at.values[0], self.at.values[1]) = (x, y);
            return Ok(());
        }
        open.alike = if is_alike { open.alike + 1 } else { 0 };
        open.last = Some(*hole);
        let at = self.place(&hole.at);
        let Some(open) = &mut self.cycle else { return impossible("a hole outside a cycle") };
        let defaults = self.expectation.defaults[usize::from(self.units == Some(Units::Mm))];
        let rpm = self.state.speed;
        let mut planes = Plan::of(&open.spec, hole.depth, &defaults, rpm).map_err(Box::<Diag>::from)?;
        if self.mode == FeedMode::PerRev {
            planes.lead = Some(planes.feed);
        }
        let Some(point) = at.get(DEPTH).or(open.point) else { return unproven(Unmodelled::HoleWithout) };
        open.point = Some(point);
        let clear = point + planes.clear;
        let first = open.spec.return_height.map(|height| *open.first_return.get_or_insert(point + height));
        let return_plane = first.map_or(clear, |first| first.max(clear));
        let kind = open.spec.kind;
        let custom = matches!(kind, CycleKind::Custom1 | CycleKind::Custom2 | CycleKind::Custom3);
        let mut steps = std::mem::take(&mut self.steps);
        let top = return_plane - point;
        if custom {
            // a custom cycle may make more moves, but it must go down to the bottom and come back
            steps.list.clear();
            let feed = Step::Feed(planes.bottom, planes.feed);
            steps.list.extend([Step::Rapid(planes.clear), feed, Step::Rapid(top)]);
        } else {
            plan(&open.spec, &planes, top, &defaults, &mut steps).map_err(Box::<Diag>::from)?;
        }
        let pecks = custom
            || matches!(kind, CycleKind::Deep | CycleKind::Chipbreak)
            || (kind.is_tap() && (open.spec.mode.is_some() || open.spec.step.is_some()));
        let comes_out = kind == CycleKind::Deep || kind == CycleKind::Chipbreak && open.spec.times.is_some();
        let floats = open.spec.rigid == Some(false);
        let reverses = kind.is_tap() && !open.spec.norevr && !open.spec.rapout;
        // if only the form calls its taps rigid, it knows whether a parameter of the control makes G84 rigid
        let due = self.expectation.announces_taps || open.spec.rigid == Some(true);
        let rigid = open
            .spec
            .rigid
            .or(self.expectation.rigid_tap)
            .filter(|rigid| reverses && (!rigid || due || !taps_ahead(self.control)));
        let mut target = self.target(&hole.at);
        target.set(DEPTH, return_plane);
        let plane = steps.list.iter().take_while(|step| matches!(step, Step::Rapid(_))).last();
        let plane = if let Some(Step::Rapid(height)) = plane { point + height } else { clear };
        let expected = Expected {
            at: self.whole(&target),
            plane,
            bottom: point + planes.bottom,
            dwell: planes.dwell,
            pecks,
            comes_out,
            drilled_in_one: kind == CycleKind::Drill,
            is_tap: kind.is_tap(),
            feeds_out: kind.is_tap() || kind == CycleKind::Ream,
            custom,
        };
        let list = std::mem::take(&mut steps.list);
        let before = self.state.clone();
        // change the state only if needed, because all holes of a cycle share one state
        if before.rigid != rigid {
            self.state.rigid = rigid;
        }
        if let (Some(inwards), Some(Rotation::Cw | Rotation::Ccw)) = (kind.inwards(), before.rotation) {
            self.state.rotation = Some(rotation(inwards)); // also if the spindle turned the other way before
            self.state.into_tap = Some(rotation(inwards)).filter(|_| floats);
        }
        let done = self.steps(&list, point, target, &expected, to);
        self.state = before;
        steps.list = list;
        self.steps = steps;
        done
    }

    fn steps(&mut self, steps: &[Step], point: f64, target: Axes, hole: &Expected, to: &mut impl Intent) -> Done {
        let (feed, state) = (self.feed, self.state.clone());
        // after a tap, the rotation of the spindle outside the hole does not matter
        let mut spin = self.state.rotation.map(Spin::Turns).filter(|_| !hole.is_tap);
        self.at = target;
        to.rapid(self.rapid_to(&target, None))?;
        to.hole_begins(hole);
        for step in steps {
            let mut at = target;
            match *step {
                Step::Rapid(height) => {
                    at.set(DEPTH, point + height);
                    self.at = at;
                    to.rapid(self.rapid_to(&at, spin))?;
                }
                Step::RapidAside(height, x, y) => {
                    at.set(DEPTH, point + height);
                    at.values[0] += x;
                    at.values[1] += y;
                    self.at = at;
                    to.rapid(self.rapid_to(&at, spin))?;
                }
                Step::Feed(height, feed) => {
                    at.set(DEPTH, point + height);
                    self.feed = Some(feed);
                    let to_there = self.whole(&at);
                    let cut = self.cut(What::Line { to: to_there });
                    self.at = at;
                    if cut.from != to_there {
                        to.cut(&cut, Some(hole))?;
                    }
                }
                Step::Dwell(seconds) => wait(seconds, to),
                Step::SpindleStop | Step::Orient(_) => {
                    self.state.rotation = self.state.rotation.map(|_| Rotation::Stop);
                    spin = match *step {
                        Step::Orient(angle) => Some(Spin::At(angle)),
                        _ => self.state.rotation.map(Spin::Turns),
                    };
                }
                Step::SpindleStart => {
                    self.state = state.clone();
                    spin = state.rotation.map(Spin::Turns).filter(|_| !hole.is_tap);
                }
                Step::SpindleReverse(ratio) => {
                    self.state.rotation = self.state.rotation.map(Rotation::reversed);
                    self.state.speed = self.state.speed.map(|speed| speed * ratio);
                    spin = None;
                }
                Step::ProgramStop => to.stop(StopKind::Program),
            }
        }
        (self.feed, self.state) = (feed, state);
        to.hole_ends(hole)
    }
}
