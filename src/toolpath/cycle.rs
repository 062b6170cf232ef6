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
    /// The angle in degrees from 0 to 360, where the form's is `form`.
    pub fn angle(self, form: f64) -> f64 {
        if let Orient::At(angle) = self { angle.rem_euclid(360.0) } else { form }
    }
}

/// Most pecks of one hole: more is a slip of the decimal point.
pub const MOST_PECKS: usize = 10_000;

/// A canned cycle without its points. Lengths are in the job's units; heights are distances
/// along the tool axis from each point.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleSpec {
    /// Kind of the cycle.
    pub kind: CycleKind,
    /// How deep the bottom is below the point, positive down.
    pub depth: Option<f64>,
    /// How far above the point the feed begins: the R plane.
    pub clear: Option<f64>,
    /// Return plane above the first point.
    pub return_height: Option<f64>,
    /// Feed into the hole, a length a minute or a turn as the operation says.
    pub feed: Option<f64>,
    /// Feed of plunges; `None`: `feed`.
    pub plunge: Option<f64>,
    /// How much deeper each peck goes, counted from the R plane.
    pub step: Option<f64>,
    /// Depth of the first peck.
    pub first_step: Option<f64>,
    /// How far above the last depth the feed begins again; after a chip break, how far the tool lifts.
    pub back: Option<f64>,
    /// Dwell at the bottom, in seconds.
    pub dwell: Option<f64>,
    /// Dwell at the bottom, in turns of the spindle.
    pub revs: Option<f64>,
    /// How far below the R plane the rapid goes on.
    pub rapto: Option<f64>,
    /// Angle at which a boring cycle stops the spindle.
    pub orient: Option<Orient>,
    /// How far a boring cycle moves off the wall, without `offset_y` along the first axis.
    pub offset: Option<f64>,
    /// Feed out of the hole over feed into it.
    pub ratio: Option<f64>,
    /// Number of starts of a tapped thread.
    pub starts: Option<f64>,
    /// Tapping in step with the spindle; else as the form says.
    pub rigid: Option<bool>,
    /// Number of chip breaks between full retracts.
    pub times: Option<f64>,
    /// How much each peck is less than the one before.
    pub decr: Option<f64>,
    /// Depth of the least peck.
    pub min_step: Option<f64>,
    /// Diameter of a countersink, from which comes its depth.
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
    /// A tap that does not reverse the spindle.
    pub norevr: bool,
    /// A tap that leaves the hole by a rapid.
    pub rapout: bool,
    /// How far a boring cycle lifts while it is off the wall.
    pub jog: Option<f64>,
    /// How far a boring cycle moves off the wall along y, where `offset` is the part along x.
    pub offset_y: Option<f64>,
    /// Steps count from the point, as in APT, and not from the clearance plane, as a control's Q does.
    pub steps_from_point: bool,
    /// The cycle is printed as single moves, whatever the form has.
    pub emulate: bool,
}

impl CycleSpec {
    /// A cycle of this kind that says nothing else.
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

    /// How deep the holes are that the cycle says, in the job's units: by `depth`, else by the last of `webs` or `pecks`.
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
