//! The state of reading a file. The state is divided into parts, so each statement uses only the parts that it needs.

use super::coded::Coded;
use super::cycle_dialects::Heights;
use super::dialect::Sense;
use super::feed_unit::Feed;
use super::job::Job;
use super::setup::{Frame, Setups};
use crate::toolpath::{CycleSpec, LastDwell, Side};

/// The whole state. Most functions use only some parts of the state. Functions that may make a motion use the whole
/// state.
pub(super) struct State<'s> {
    pub job: Job<'s>,
    pub motion: Motion,
    pub arcs: Arcs,
    pub feeds: Feeds,
    pub cycle: Cycle,
    /// The setups, if one of several is selected or all are listed.
    pub setups: Option<Setups>,
}

/// The tool's position and the mode of the next motion.
#[derive(Default)]
pub(super) struct Motion {
    pub shift: Shift,
    /// Position of the tool. After a hole, this is the position above the hole.
    pub position: Option<[f64; 3]>,
    /// The last programmed point, from which GODLTA counts.
    pub point: Option<[f64; 3]>,
    /// The tool axis.
    pub axis: Axis,
    /// Whether the next motion is a rapid.
    pub rapid: bool,
    /// Whether the first motion after the end of a cycle is a rapid. A feed in this motion or before it makes the motion a
    /// cut.
    pub rapid_after_cycle: bool,
    /// Whether the tool has moved since the last tool change.
    pub has_moved: bool,
    /// Line of a FROM that gives another position than the motion before it, if no motion has followed it.
    pub jump: Option<u64>,
    pub cutcom: Cutcom,
    /// Whether the tool axis may turn with each motion (MULTAX/ON).
    pub many_axes: bool,
    /// The last coordinate system of the file, if no motion has followed it: its z axis and its line.
    pub frame: Option<([f64; 3], u64)>,
}

/// The tool axis as a unit vector. At the start of a file the tool axis is vertical.
pub(super) struct Axis(pub [f64; 3]);

impl Default for Axis {
    fn default() -> Self {
        Axis([0.0, 0.0, 1.0])
    }
}

/// Shift of all positions: TRANS is added and ORIGIN is subtracted.
#[derive(Default)]
pub(super) struct Shift {
    pub trans: [f64; 3],
    pub origin: [f64; 3],
    /// Frame of the selected setup.
    pub frame: Option<Frame>,
}

impl Shift {
    /// Converts a position of the file to a position of the job.
    #[inline]
    pub fn of(&self, point: [f64; 3]) -> [f64; 3] {
        let mut to = point;
        for (i, value) in to.iter_mut().enumerate() {
            *value += self.trans[i] - self.origin[i];
        }
        self.turned(to)
    }

    /// Converts a direction of the file to a direction of the job.
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
    /// The change that the next motion makes: `Some(Some(side))` turns compensation on, `Some(None)` turns it off.
    pub asked: Option<Option<Side>>,
    /// Whether compensation is on.
    pub on: bool,
}

impl Cutcom {
    /// Whether compensation is on, or changes with the next motion.
    pub fn is_in_use(&self) -> bool {
        self.on || self.asked.is_some()
    }

    /// The word of the side to which the next motion would turn compensation on.
    pub fn waiting_side(&self) -> Option<&'static str> {
        self.asked.flatten().map(|side| if side == Side::Left { "LEFT" } else { "RIGHT" })
    }
}

/// The next arc, and the direction of circles.
#[derive(Default)]
pub(super) struct Arcs {
    /// The circle on which the next GOTO moves.
    pub pending: Option<PendingArc>,
    /// The direction from INDIRV in which the next TLON begins.
    pub direction: Option<[f64; 3]>,
    /// Direction of the tool at the end of the last motion.
    pub heading: Option<Heading>,
    /// The direction of circles, as found from tangents.
    pub sense: Option<Sense>,
}

/// A direction in space, as a unit vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heading(pub [f64; 3]);

impl Heading {
    /// The direction from one point to another; `None` if the points are equal.
    pub fn between(from: [f64; 3], to: [f64; 3]) -> Option<Heading> {
        let way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let length = way.iter().map(|c| c * c).sum::<f64>().sqrt();
        (length > 1e-9).then(|| Heading(way.map(|c| c / length)))
    }
}

/// A circle on which the next GOTO moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct PendingArc {
    pub centre: [f64; 3],
    /// Index of the circle's axis (x, y or z). `up`: whether the axis points in the positive direction.
    pub axis: usize,
    pub up: bool,
    /// The radius, if given.
    pub radius: Option<f64>,
    /// The direction, if the statement defines it.
    pub sense: Option<Sense>,
    /// TIMES,n: the arc ends when the tool reaches the end point for the n-th time.
    pub times: Option<u32>,
    /// ANGLE,a: the angle from start to end, in degrees.
    pub angle: Option<f64>,
}

/// The active feed, and whether a tool change ended a cycle.
#[derive(Default)]
pub(super) struct Feeds {
    pub feed: Option<Feed>,
    /// Line of a tool change that ended a cycle. The line is cleared when a feed or a cycle follows.
    pub cut_off: Option<u64>,
}

/// The setting of CYCLE/RETURN, which determines the return plane of the following cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum ReturnMode {
    #[default]
    AsCoded,
    AtStart,
    Above(f64),
    Off,
}

impl ReturnMode {
    /// The return plane of a cycle. CYCLE/RETURN has priority over `coded`, the return in the cycle's own statement. `None`:
    /// the tool returns to the clearance of each hole.
    pub fn over(self, coded: Option<CodedReturn>) -> Option<CodedReturn> {
        match self {
            ReturnMode::AsCoded => coded,
            ReturnMode::AtStart => Some(CodedReturn::Start),
            ReturnMode::Above(above) => Some(CodedReturn::Above(above)),
            ReturnMode::Off => None,
        }
    }
}

/// A return plane of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CodedReturn {
    /// The clearance of the first point.
    Clearance,
    /// A height above the first point of the cycle.
    Above(f64),
    /// The tool's height before the cycle.
    Start,
    /// A height in the file's coordinates. `above`: the same height above the first point, if the file gives it.
    Height { height: f64, above: Option<f64> },
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
    /// Return plane of the active cycle, as its statement gives it; `None`: the clearance of each hole.
    pub returns: Option<CodedReturn>,
    /// The heights of the cycle, for a CAM system that gives heights instead of a clearance.
    pub heights: Option<Heights>,
    /// Return plane as a height in the file's coordinates. The height is known after the first point.
    pub plane: Option<Option<f64>>,
}

impl Cycle {
    /// Whether a cycle is active, so that points are holes.
    #[inline]
    pub fn is_active(&self) -> bool {
        self.active.is_some()
    }
}
