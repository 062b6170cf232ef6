//! The output of the job's side: its cuts, holes, threads and paths.

use super::cut::{Cut, Place, Rapid};
use super::passage::Frame;
use super::tables::Unmodelled;
use super::wire_codes::Coded;
use crate::diag::{Code, Diag};
use crate::toolpath::{self, StopKind, Units};

/// The receiver of the job's motions, in their order.
pub(super) trait Intent {
    /// Units of the job; in these units, how far lines may deviate from an arc, and the smallest digit of the form along
    /// a hole.
    fn units(&mut self, units: Units, chord: f64, increment: f64);
    /// A rapid.
    fn rapid(&mut self, rapid: Rapid) -> Done;
    /// A cut.
    fn cut(&mut self, cut: &Cut, hole: Option<&Expected>) -> Done;
    /// A rapid that may also be a feed move, because it turns compensation on or off.
    fn rapid_or_feed(&mut self, cut: &Cut) -> Done;
    /// A dwell in seconds. Not a number means any length.
    fn wait(&mut self, seconds: f64);
    /// A stop.
    fn stop(&mut self, kind: StopKind);
    /// A thread with all its passes, and the state in force.
    fn thread(&mut self, cut: &Cut, thread: &Threaded) -> Done;
    /// The job is for a lathe. X in the program is a diameter or a radius.
    fn is_of_lathe(&mut self, by_diameter: bool);
    /// The moves of a hole begin.
    fn hole_begins(&mut self, hole: &Expected);
    /// The moves of a hole end.
    fn hole_ends(&mut self, hole: &Expected) -> Done;
    /// The tool or the work offset changes. From here on, positions are in another frame. `length`: the tool's register.
    fn changed(&mut self, frame: Frame, length: Option<f64>, tool: bool);
    /// The tool goes home. From there on its position is unknown. `length`: the tool's register.
    fn home(&mut self, length: Option<f64>);
    /// The job is over.
    fn finish(&mut self) -> Done;
    /// The job is for a wire EDM machine.
    fn is_of_wire(&mut self);
    /// A code that threads or cuts the wire, drills its start hole or fills the tank.
    fn wire(&mut self, code: Coded);
    /// The current item of the job.
    fn place(&self) -> toolpath::Place;
    /// Sets the item that the next motions belong to.
    fn comes_from(&mut self, place: toolpath::Place);
}

/// Success, or a finding that ends the comparison.
pub(super) type Done<T = ()> = Result<T, Box<Diag>>;

/// The requirements for a hole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expected {
    /// The position above the hole.
    pub at: Place,
    /// The height where the feed begins.
    pub plane: f64,
    pub bottom: f64,
    pub dwell: Option<f64>,
    /// Whether the hole may be made in other pecks.
    pub pecks: bool,
    /// Whether the tool leaves the hole between pecks. For taps this is a setting of the control.
    pub comes_out: bool,
    /// Whether the job drills the hole without pecks. The program may still peck it.
    pub drilled_in_one: bool,
    /// Whether the hole is tapped: its feed and speed define the pitch.
    pub is_tap: bool,
    /// Whether the tool may leave the hole at feed to a higher position than in the job.
    pub feeds_out: bool,
    /// Whether the moves of the hole are defined only by the form.
    pub custom: bool,
}

/// The requirements for one start of a thread. X is a radius.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Threaded {
    /// The position where its passes begin, beside the thread.
    pub begin: Place,
    /// Its end along the axis.
    pub end: f64,
    /// Radius of its crest at the end.
    pub crest: f64,
    /// Radius at the start of a pass minus the radius at its end.
    pub taper: f64,
    /// -1 if it is cut towards the axis, 1 if away from it.
    pub inward: f64,
    /// Depths of the job's passes below the crest.
    pub passes: Vec<f64>,
    /// Distance between two turns.
    pub lead: f64,
}

/// Fails because the motions are not known well enough for a proof.
pub(super) fn unproven<T>(what: Unmodelled) -> Done<T> {
    Err(Box::new(
        Diag::new(Code::PV020, what.why())
            .help("docs/verify.md lists the cases that can't be proven; prove the rest as a separate job"),
    ))
}
