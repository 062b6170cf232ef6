//! State of reading a file, in parts for the statements that use them.

use super::coded::Coded;
use super::cycle_dialects::Heights;
use super::dialect::Sense;
use super::feed_unit::Feed;
use super::job::Job;
use super::setup::{Frame, Setups};
use crate::toolpath::{CycleSpec, LastDwell, Side};

/// The whole state. Functions take only the parts that they use, or the whole if a motion may need all of it.
pub(super) struct State<'s> {
    pub job: Job<'s>,
    pub motion: Motion,
    pub arcs: Arcs,
    pub feeds: Feeds,
    pub cycle: Cycle,
    /// The setups, if one of several is read or all are listed.
    pub setups: Option<Setups>,
}

/// The tool's position, and the mode of the next motion.
#[derive(Default)]
pub(super) struct Motion {
    pub shift: Shift,
    /// Position of the tool; after a hole, the position above it.
    pub position: Option<[f64; 3]>,
    /// Last programmed point, the start for GODLTA.
    pub point: Option<[f64; 3]>,
    /// The tool axis.
    pub axis: Axis,
    /// The next motion is a rapid.
    pub rapid: bool,
    /// The first motion after the end of a cycle is a rapid, unless a feed comes first.
    pub rapid_after_cycle: bool,
    pub cutcom: Cutcom,
    /// A coordinate system of the file that has no motion yet: its z axis, and its line.
    pub frame: Option<([f64; 3], u64)>,
}

/// The tool axis, a unit vector. At the start of a file the tool is vertical.
pub(super) struct Axis(pub [f64; 3]);

impl Default for Axis {
    fn default() -> Self {
        Axis([0.0, 0.0, 1.0])
    }
}

/// Offset of all positions: TRANS minus ORIGIN.
#[derive(Default)]
pub(super) struct Shift {
    pub trans: [f64; 3],
    pub origin: [f64; 3],
    /// Frame of the selected setup.
    pub frame: Option<Frame>,
}

impl Shift {
    /// Converts a position of the file to one of the job.
    #[inline]
    pub fn of(&self, point: [f64; 3]) -> [f64; 3] {
        let mut to = point;
        for (i, value) in to.iter_mut().enumerate() {
            *value += self.trans[i] - self.origin[i];
        }
        self.turned(to)
    }

    /// Converts a direction of the file to one of the job.
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
    /// The side that the next motion turns on; `None` inside: the next motion turns compensation off.
    pub asked: Option<Option<Side>>,
    /// Compensation is on, or will be with the next motion.
    pub on: bool,
}

/// Pending arcs, and the direction of circles.
#[derive(Default)]
pub(super) struct Arcs {
    /// The circle along which the next GOTO cuts.
    pub pending: Option<PendingArc>,
    /// Direction from INDIRV in which the next TLON starts.
    pub direction: Option<[f64; 3]>,
    /// Direction of the tool at the end of the last motion.
    pub heading: Option<Heading>,
    /// Direction of circles, as found from their tangents.
    pub sense: Option<Sense>,
}

/// A direction in space, of length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heading(pub [f64; 3]);

impl Heading {
    /// The direction from one point to another.
    pub fn between(from: [f64; 3], to: [f64; 3]) -> Option<Heading> {
        let way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let length = way.iter().map(|c| c * c).sum::<f64>().sqrt();
        (length > 1e-9).then(|| Heading(way.map(|c| c / length)))
    }
}

/// A circle along which the next GOTO cuts.
#[derive(Clone, Copy, Debug)]
pub(super) struct PendingArc {
    pub centre: [f64; 3],
    /// Index of its axis (x, y or z), and whether the axis points in the positive direction.
    pub axis: usize,
    pub up: bool,
    /// The radius, if given.
    pub radius: Option<f64>,
    /// The direction, if the statement defines it.
    pub sense: Option<Sense>,
    /// TIMES,n: the arc ends at the n-th arrival at the end point.
    pub times: Option<u32>,
    /// ANGLE,a: degrees from start to end.
    pub angle: Option<f64>,
}

/// The active feed.
#[derive(Default)]
pub(super) struct Feeds {
    pub feed: Option<Feed>,
    /// Line of a tool change that ended a cycle; cleared when a feed or a cycle follows.
    pub cut_off: Option<u64>,
}

/// CYCLE/RETURN: it sets the return plane of the following cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum ReturnMode {
    #[default]
    AsCoded,
    AtStart,
    Above(f64),
    Off,
}

impl ReturnMode {
    /// The return of a cycle. CYCLE/RETURN overrides `coded`, the return in the cycle's own statement. `None`: the tool returns
    /// to each hole's clearance.
    pub fn over(self, coded: Option<CodedReturn>) -> Option<CodedReturn> {
        match self {
            ReturnMode::AsCoded => coded,
            ReturnMode::AtStart => Some(CodedReturn::Start),
            ReturnMode::Above(above) => Some(CodedReturn::Above(above)),
            ReturnMode::Off => None,
        }
    }
}

/// Return plane of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CodedReturn {
    /// The clearance of the first point.
    Clearance,
    /// A height above the first point of the cycle.
    Above(f64),
    /// The tool's height before the cycle.
    Start,
    /// This height in the file's coordinates.
    Height(f64),
}

/// The active cycle, and values that are kept between cycles.
#[derive(Debug, Default)]
pub(super) struct Cycle {
    pub active: Option<CycleSpec>,
    pub last: Option<Coded>,
    pub clear: Option<f64>,
    pub dwell: LastDwell,
    pub emulate: bool,
    pub return_mode: ReturnMode,
    /// Return plane of the active cycle, set by its statement; `None`: each hole's own clearance.
    pub returns: Option<CodedReturn>,
    /// Heights of the cycle, for a system that gives them instead of a clearance.
    pub heights: Option<Heights>,
    /// Return plane as a height of the file, known from the first point on.
    pub plane: Option<Option<f64>>,
}

impl Cycle {
    /// Is a cycle active, so that points are holes?
    #[inline]
    pub fn is_active(&self) -> bool {
        self.active.is_some()
    }
}
