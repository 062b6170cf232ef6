//! A canned cycle and its holes.

use super::axes::Axes;
use super::kind::CycleKind;

/// One peck of a cycle, given by its absolute depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peck {
    /// Depth below the point of the hole, in the job's units, positive down.
    pub to: f64,
    /// Feed of this peck; `None`: the feed of the cycle.
    pub feed: Option<f64>,
}

/// The angle at which a cycle stops the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orient {
    /// The angle that the form defines (`CycleOrient`).
    ByForm,
    /// An angle in degrees.
    At(f64),
}

impl Orient {
    /// The angle in degrees from 0 to 360. `form`: the angle that the form defines.
    pub fn angle(self, form: f64) -> f64 {
        if let Orient::At(angle) = self { angle.rem_euclid(360.0) } else { form }
    }
}

/// The largest number of pecks of one hole. A larger number is probably the result of a misplaced decimal point.
pub const MOST_PECKS: usize = 10_000;

/// A canned cycle without its points. Lengths are in the job's units. Heights are distances along the tool axis,
/// measured from each point.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleSpec {
    /// Kind of the cycle.
    pub kind: CycleKind,
    /// Depth of the bottom below the point of the hole, positive down.
    pub depth: Option<f64>,
    /// Height of the R plane above the point of the hole. The feed into the hole begins at the R plane.
    pub clear: Option<f64>,
    /// Height of the return plane above the first point.
    pub return_height: Option<f64>,
    /// Feed into the hole, per minute or per turn according to the operation.
    pub feed: Option<f64>,
    /// Feed of plunges; `None`: the same as `feed`.
    pub plunge: Option<f64>,
    /// Depth of each peck. Pecks are counted from the R plane.
    pub step: Option<f64>,
    /// Depth of the first peck.
    pub first_step: Option<f64>,
    /// Height above the last depth at which the feed begins again. After a chip break, the height by which the tool is
    /// lifted.
    pub back: Option<f64>,
    /// Dwell at the bottom, in seconds.
    pub dwell: Option<f64>,
    /// Dwell at the bottom, in turns of the spindle.
    pub revs: Option<f64>,
    /// How far an additional rapid goes below the R plane.
    pub rapto: Option<f64>,
    /// Angle at which a boring cycle stops the spindle.
    pub orient: Option<Orient>,
    /// Distance by which a boring cycle moves off the wall. Without `offset_y`, the move is along the first axis.
    pub offset: Option<f64>,
    /// Feed out of the hole divided by the feed into it.
    pub ratio: Option<f64>,
    /// Number of starts of a tapped thread.
    pub starts: Option<f64>,
    /// Whether the tap is rigid (synchronised with the spindle); `None`: as the form defines.
    pub rigid: Option<bool>,
    /// Number of chip breaks between full retracts.
    pub times: Option<f64>,
    /// Amount by which each peck is smaller than the previous one.
    pub decr: Option<f64>,
    /// Depth of the smallest peck.
    pub min_step: Option<f64>,
    /// Diameter of a countersink. The depth is calculated from this diameter and from `angle`.
    pub diameter: Option<f64>,
    /// Included angle of a countersink, in degrees.
    pub angle: Option<f64>,
    /// Diameter of the existing hole under a countersink.
    pub hole_diameter: Option<f64>,
    /// Depths of a cycle through webs, positive down: the end of the first web, the start and end of the next, and so on.
    pub webs: Vec<f64>,
    /// Pecks with absolute depths, instead of `step`.
    pub pecks: Vec<Peck>,
    /// How a tap pecks: with full retracts or with chip breaks.
    pub mode: Option<CycleKind>,
    /// Whether the spindle does not reverse in a tap.
    pub norevr: bool,
    /// Whether the tap leaves the hole at rapid.
    pub rapout: bool,
    /// Height by which a boring cycle lifts the tool while it is off the wall.
    pub jog: Option<f64>,
    /// Distance by which a boring cycle moves off the wall along y. If `offset_y` is set, `offset` is the distance
    /// along x.
    pub offset_y: Option<f64>,
    /// Whether steps are counted from the point of the hole, as in APT. Otherwise steps are counted from the clearance
    /// plane, like Q on a control.
    pub steps_from_point: bool,
    /// Whether the cycle is printed as single moves, even if the form has a sequence for it.
    pub emulate: bool,
}

impl CycleSpec {
    /// A cycle of this kind without any values.
    pub fn new(kind: CycleKind) -> CycleSpec {
        CycleSpec {
            kind,
            depth: None,
            clear: None,
            return_height: None,
            feed: None,
            plunge: None,
            step: None,
            first_step: None,
            back: None,
            dwell: None,
            revs: None,
            rapto: None,
            orient: None,
            offset: None,
            ratio: None,
            starts: None,
            rigid: None,
            times: None,
            decr: None,
            min_step: None,
            diameter: None,
            angle: None,
            hole_diameter: None,
            webs: Vec::new(),
            pecks: Vec::new(),
            mode: None,
            norevr: false,
            rapout: false,
            jog: None,
            offset_y: None,
            steps_from_point: false,
            emulate: false,
        }
    }

    /// Depth of the cycle's holes, in the job's units: `depth`, or else the last of `webs` or `pecks`.
    pub fn deepest(&self) -> Option<f64> {
        self.depth.or_else(|| self.webs.last().copied()).or_else(|| self.pecks.last().map(|peck| peck.to))
    }
}

/// One point of a cycle, at which a hole is made.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Hole {
    /// The programmed point: the top of the hole.
    pub at: Axes,
    /// Depth of this hole below `at`, in the job's units; `None`: the depth of the cycle.
    pub depth: Option<f64>,
}
