//! A canned cycle and its holes.

use super::axes::Axes;
use super::kind::CycleKind;

/// One absolute step of a peck cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peck {
    /// Depth below the point, in the job's units, positive down.
    pub to: f64,
    /// Feed of the step; `None`: the feed of the cycle.
    pub feed: Option<f64>,
}

/// The angle at which a cycle stops the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orient {
    /// The angle of the form (`CycleOrient`).
    ByForm,
    /// An angle in degrees.
    At(f64),
}

impl Orient {
    /// The angle in degrees from 0 to 360. `form`: the angle of the form.
    pub fn angle(self, form: f64) -> f64 {
        if let Orient::At(angle) = self { angle.rem_euclid(360.0) } else { form }
    }
}

/// The largest number of pecks of one hole. A larger number comes from a misplaced decimal point.
pub const MOST_PECKS: usize = 10_000;

/// A canned cycle without its points. Lengths are in the job's units; heights are distances
/// along the tool axis from each point.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleSpec {
    /// Kind of the cycle.
    pub kind: CycleKind,
    /// Depth of the bottom below the point, positive down.
    pub depth: Option<f64>,
    /// Height of the R plane above the point, where the feed begins.
    pub clear: Option<f64>,
    /// Return plane above the first point.
    pub return_height: Option<f64>,
    /// Feed into the hole, per minute or per turn as in the operation.
    pub feed: Option<f64>,
    /// Feed of plunges; `None`: `feed`.
    pub plunge: Option<f64>,
    /// Depth of each peck, counted from the R plane.
    pub step: Option<f64>,
    /// Depth of the first peck.
    pub first_step: Option<f64>,
    /// Height above the last depth where the feed begins again; after a chip break, the height of the lift.
    pub back: Option<f64>,
    /// Dwell at the bottom, in seconds.
    pub dwell: Option<f64>,
    /// Dwell at the bottom, in turns of the spindle.
    pub revs: Option<f64>,
    /// Distance of the extra rapid below the R plane.
    pub rapto: Option<f64>,
    /// Angle at which a boring cycle stops the spindle.
    pub orient: Option<Orient>,
    /// Distance that a boring cycle moves off the wall. Without `offset_y`, this is along the first axis.
    pub offset: Option<f64>,
    /// Feed out of the hole divided by the feed into it.
    pub ratio: Option<f64>,
    /// Number of starts of a tapped thread.
    pub starts: Option<f64>,
    /// Whether the tap is rigid, in step with the spindle; `None`: as in the form.
    pub rigid: Option<bool>,
    /// Number of chip breaks between full retracts.
    pub times: Option<f64>,
    /// Amount by which each peck is smaller than the previous one.
    pub decr: Option<f64>,
    /// Depth of the smallest peck.
    pub min_step: Option<f64>,
    /// Diameter of a countersink. The depth is calculated from it.
    pub diameter: Option<f64>,
    /// Full angle of a countersink, in degrees.
    pub angle: Option<f64>,
    /// Diameter of the hole under a countersink.
    pub hole_diameter: Option<f64>,
    /// Depths of a cycle through webs, positive down: end of the first, start and end of the next, and so on.
    pub webs: Vec<f64>,
    /// Absolute steps, instead of `step`.
    pub pecks: Vec<Peck>,
    /// Kind of pecks of a tap: deep or chip breaking.
    pub mode: Option<CycleKind>,
    /// Whether the tap does not reverse the spindle.
    pub norevr: bool,
    /// Whether the tap leaves the hole by a rapid.
    pub rapout: bool,
    /// Height that a boring cycle lifts while the tool is off the wall.
    pub jog: Option<f64>,
    /// Distance that a boring cycle moves off the wall along y; `offset` is then the distance along x.
    pub offset_y: Option<f64>,
    /// Whether steps are counted from the point, as in APT, instead of the clearance plane, as with a control's Q.
    pub steps_from_point: bool,
    /// Whether the cycle is printed as single moves even if the form has a cycle for it.
    pub emulate: bool,
}

impl CycleSpec {
    /// A cycle of this kind without further values.
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

    /// Depth of the cycle's holes, in the job's units: `depth`, else the last of `webs` or `pecks`.
    pub fn deepest(&self) -> Option<f64> {
        self.depth.or_else(|| self.webs.last().copied()).or_else(|| self.pecks.last().map(|peck| peck.to))
    }
}

/// One point of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Hole {
    /// The control point: the top of the hole.
    pub at: Axes,
    /// Depth of this hole below `at`, in the job's units; `None`: the cycle's.
    pub depth: Option<f64>,
}
