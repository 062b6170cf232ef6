//! What the job's side tells: its cuts, holes, threads and ways.

use super::cut::{Cut, Place, Rapid};
use super::passage::Frame;
use super::tables::Unmodelled;
use super::wire_codes::Coded;
use crate::diag::{Code, Diag};
use crate::toolpath::{self, StopKind, Units};

/// What the job's side tells, in the order of its motions.
pub(super) trait Intent {
    /// Units of the job, how far lines may leave an arc in them, and one digit of the form along a hole.
    fn units(&mut self, units: Units, chord: f64, increment: f64);
    /// A rapid.
    fn rapid(&mut self, rapid: Rapid) -> Done;
    /// A cut.
    fn cut(&mut self, cut: &Cut, hole: Option<&Expected>) -> Done;
    /// A rapid that may feed, as it turns compensation on or off.
    fn rapid_or_feed(&mut self, cut: &Cut) -> Done;
    /// A dwell in seconds; not a number: of any length.
    fn wait(&mut self, seconds: f64);
    /// A stop.
    fn stop(&mut self, kind: StopKind);
    /// A thread, all its passes; with what holds there.
    fn thread(&mut self, cut: &Cut, thread: &Threaded) -> Done;
    /// The job is for a lathe, whose X the program counts by diameter or by radius.
    fn is_of_lathe(&mut self, by_diameter: bool);
    /// The moves of a hole begin.
    fn hole_begins(&mut self, hole: &Expected);
    /// The moves of a hole end.
    fn hole_ends(&mut self, hole: &Expected) -> Done;
    /// The tool or the work offset changes: places are others from here on. `length`: the tool's register.
    fn changed(&mut self, frame: Frame, length: Option<f64>, tool: bool);
    /// The tool goes to the machine's own place: from there on its place is unknown. `length`: the tool's register.
    fn home(&mut self, length: Option<f64>);
    /// The job is over.
    fn finish(&mut self) -> Done;
    /// The job is for a wire EDM machine.
    fn is_of_wire(&mut self);
    /// A code that threads or cuts the wire, drills its start hole or fills the tank.
    fn wire(&mut self, code: Coded);
    /// The item of the job that is looked at.
    fn place(&self) -> toolpath::Place;
    /// What comes now is this item's.
    fn comes_from(&mut self, place: toolpath::Place);
}

/// What goes well, or a finding that ends the comparison.
pub(super) type Done<T = ()> = Result<T, Box<Diag>>;

/// What a hole must be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expected {
    /// The place over the hole.
    pub at: Place,
    /// Where the feed begins.
    pub plane: f64,
    pub bottom: f64,
    pub dwell: Option<f64>,
    /// The hole may be made in other pecks.
    pub pecks: bool,
    /// The tool comes out of the hole between pecks; how a tap does that is the control's own setting.
    pub comes_out: bool,
    /// The job drills it in one, and it may be made in pecks.
    pub drilled_in_one: bool,
    /// A tap: feed and speed are its pitch.
    pub is_tap: bool,
    /// The hole may be left at feed farther up than the job does.
    pub feeds_out: bool,
    /// The moves of the hole are known to the form alone.
    pub custom: bool,
}

/// What one start of a thread must be; radii.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Threaded {
    /// Where its passes begin: beside it.
    pub begin: Place,
    /// Its end along the axis.
    pub end: f64,
    /// Radius of its crest at the end.
    pub crest: f64,
    /// Radius where a pass begins, less that at its end.
    pub taper: f64,
    /// -1 where it is cut towards the axis, 1 away from it.
    pub inward: f64,
    /// How deep the job's passes go below the crest.
    pub passes: Vec<f64>,
    /// From turn to turn.
    pub lead: f64,
}

/// Something whose motions are not known well enough to prove them.
pub(super) fn unproven<T>(what: Unmodelled) -> Done<T> {
    Err(Box::new(
        Diag::new(Code::PV020, what.why())
            .help("docs/verify.md lists what is not proven; prove the rest as a job of its own"),
    ))
}
