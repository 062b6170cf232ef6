//! What a file has said so far, in parts by the statements that touch them.

use super::coded::Coded;
use super::cycle_dialects::Heights;
use super::dialect::Sense;
use super::feed_unit::Feed;
use super::job::Job;
use super::setup::{Frame, Setups};
use crate::toolpath::{CycleSpec, LastDwell, Side};

/// All parts. A statement's function takes those that it touches; the whole where a motion may mean any of them.
pub(super) struct State<'s> {
    pub job: Job<'s>,
    pub motion: Motion,
    pub arcs: Arcs,
    pub feeds: Feeds,
    pub cycle: Cycle,
    /// Where one setup of several is read, or all are listed.
    pub setups: Option<Setups>,
}

/// Where the tool is, and how it goes to the next point.
#[derive(Default)]
pub(super) struct Motion {
    pub shift: Shift,
    /// Where the tool is; after a hole, where it was left.
    pub position: Option<[f64; 3]>,
    /// The last point that was said, from which GODLTA counts.
    pub point: Option<[f64; 3]>,
    /// The tool axis.
    pub axis: Axis,
    /// The next motion is a rapid.
    pub rapid: bool,
    /// The next motion after the end of a cycle is a rapid, unless a feed comes first.
    pub rapid_after_cycle: bool,
    pub cutcom: Cutcom,
    /// A coordinate system of the file that no motion has been in: its z axis, and its line.
    pub frame: Option<([f64; 3], u64)>,
}

/// The tool axis, a unit vector; a file begins with an upright tool.
pub(super) struct Axis(pub [f64; 3]);

impl Default for Axis {
    fn default() -> Self {
        Axis([0.0, 0.0, 1.0])
    }
}

/// What is added to all positions: TRANS, less ORIGIN.
#[derive(Default)]
pub(super) struct Shift {
    pub trans: [f64; 3],
    pub origin: [f64; 3],
    /// The setup that is read has a frame of its own.
    pub frame: Option<Frame>,
}

impl Shift {
    /// A position of the file as one of the job.
    #[inline]
    pub fn of(&self, point: [f64; 3]) -> [f64; 3] {
        let mut to = point;
        for (i, value) in to.iter_mut().enumerate() {
            *value += self.trans[i] - self.origin[i];
        }
        self.turned(to)
    }

    /// A direction of the file as one of the job.
    #[inline]
    pub fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        match &self.frame {
            Some(frame) => frame.of(vector),
            None => vector,
        }
    }
}

/// Cutter compensation.
#[derive(Default)]
pub(super) struct Cutcom {
    /// What the next motion turns on, or (`None` inside) off.
    pub asked: Option<Option<Side>>,
    /// Compensation is on, or will be with the next motion.
    pub on: bool,
}

/// Arcs that are to come, and which way they turn.
#[derive(Default)]
pub(super) struct Arcs {
    /// The circle that the next GOTO cuts along.
    pub pending: Option<PendingArc>,
    /// The direction in which INDIRV says that the next TLON leaves.
    pub direction: Option<[f64; 3]>,
    /// Where the tool was heading at the end of the last motion.
    pub heading: Option<Heading>,
    /// Which way circles turn, as their tangents showed.
    pub sense: Option<Sense>,
}

/// A direction in space, of length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heading(pub [f64; 3]);

impl Heading {
    /// From one point to another.
    pub fn between(from: [f64; 3], to: [f64; 3]) -> Option<Heading> {
        let way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let length = way.iter().map(|c| c * c).sum::<f64>().sqrt();
        (length > 1e-9).then(|| Heading(way.map(|c| c / length)))
    }
}

/// A circle that the next GOTO cuts along.
#[derive(Clone, Copy, Debug)]
pub(super) struct PendingArc {
    pub centre: [f64; 3],
    /// Which of x, y, z its axis is, and whether it points up.
    pub axis: usize,
    pub up: bool,
    /// The radius, where it is said.
    pub radius: Option<f64>,
    /// The sense, where the statement itself has one.
    pub sense: Option<Sense>,
    /// TIMES,n: it is the n-th time that the tool comes to the end.
    pub times: Option<u32>,
    /// ANGLE,a: degrees from the beginning to the end.
    pub angle: Option<f64>,
}

/// The feed in force.
#[derive(Default)]
pub(super) struct Feeds {
    pub feed: Option<Feed>,
    /// The line of the tool change that ended a cycle, until a feed or a cycle says how points are cut.
    pub cut_off: Option<u64>,
}

/// CYCLE/RETURN: what sets the return plane of the cycles that follow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum ReturnMode {
    #[default]
    AsCoded,
    AtStart,
    Above(f64),
    Off,
}

impl ReturnMode {
    /// Where a cycle comes back to whose statement says `coded`: CYCLE/RETURN goes first. `None`: to each hole's
    /// clearance.
    pub fn over(self, coded: Option<CodedReturn>) -> Option<CodedReturn> {
        match self {
            ReturnMode::AsCoded => coded,
            ReturnMode::AtStart => Some(CodedReturn::Start),
            ReturnMode::Above(above) => Some(CodedReturn::Above(above)),
            ReturnMode::Off => None,
        }
    }
}

/// Where a cycle comes back to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CodedReturn {
    /// As high as the clearance of the first point.
    Clearance,
    /// A height above the first point of the cycle.
    Above(f64),
    /// Where the tool was before.
    Start,
    /// At this height of the file.
    Height(f64),
}

/// The cycle in force, and what is remembered from one to the next.
#[derive(Debug, Default)]
pub(super) struct Cycle {
    pub active: Option<CycleSpec>,
    pub last: Option<Coded>,
    pub clear: Option<f64>,
    pub dwell: LastDwell,
    pub emulate: bool,
    pub return_mode: ReturnMode,
    /// The return plane of the cycle in force, decided at its statement; `None`: each hole's own clearance.
    pub returns: Option<CodedReturn>,
    /// Heights that a system says instead of a clearance.
    pub heights: Option<Heights>,
    /// The return plane, once its first point is known: as a height of the file.
    pub plane: Option<Option<f64>>,
}

impl Cycle {
    /// Are points holes?
    #[inline]
    pub fn is_active(&self) -> bool {
        self.active.is_some()
    }
}
