//! The output of the job's side of the comparison: cuts, holes, threads and paths between cuts.

use super::beside::Compensated;
use super::cut::{Cut, Place, Rapid, Shared};
use super::passage::Frame;
use super::tables::Unmodelled;
use super::wire_codes::Coded;
use crate::diag::{Code, Diag};
use crate::toolpath::{self, FeedMode, StopKind, Units};

/// Receives the job's motions in their order.
pub(super) trait Intent {
    /// Sets the units of the job. Also sets two lengths in these units: the largest deviation of lines from an arc, and
    /// the smallest step that the form can print along a hole.
    fn units(&mut self, units: Units, chord: f64, increment: f64);
    /// A rapid.
    fn rapid(&mut self, rapid: Rapid) -> Done;
    /// Turns the cutter compensation on or off.
    fn compensation(&mut self, on: Option<Compensated>);
    /// Compares a straight cut if it is a usual one. `false`: the cut must be passed to [`Intent::cut`].
    fn goes_on(&mut self, cut: &Straight<'_>) -> bool;
    /// A cut.
    fn cut(&mut self, cut: &Cut, hole: Option<&Expected>) -> Done;
    /// A move that turns compensation on or off. In the program this move may be a rapid or a feed move.
    fn rapid_or_feed(&mut self, cut: &Cut) -> Done;
    /// A dwell in seconds. NaN means a dwell of any length.
    fn wait(&mut self, seconds: f64);
    /// A stop.
    fn stop(&mut self, kind: StopKind);
    /// A thread with all its passes, and the modal state at these passes.
    fn thread(&mut self, cut: &Cut, thread: &Threaded) -> Done;
    /// Sets that the job is for a lathe. `by_diameter`: X in the program is a diameter, not a radius.
    fn is_of_lathe(&mut self, by_diameter: bool);
    /// Compares a hole that differs from the last two holes only in its position. `false`: the moves of the hole must be
    /// passed on.
    fn next_hole(&mut self, at: [f64; 2]) -> bool;
    /// The moves of a hole begin.
    fn hole_begins(&mut self, hole: &Expected);
    /// The moves of a hole end.
    fn hole_ends(&mut self, hole: &Expected) -> Done;
    /// The tool or the work offset changes. Positions after this change are in another coordinate frame. `length`: the
    /// tool's length register.
    fn changed(&mut self, frame: Frame, length: Option<f64>, tool: bool);
    /// The operation after a tool change begins at this position. `axes`: the axes that its rapids give, as bits.
    fn begins_at(&mut self, first: &Place, axes: u8);
    /// The tool goes home. At home the tool's position is unknown. `length`: the tool's length register.
    fn home(&mut self, length: Option<f64>);
    /// A tool of the job has this name. The program may call the tool by its name.
    fn tool_name(&mut self, name: &str, number: f64);
    /// The job is over.
    fn finish(&mut self) -> Done;
    /// Sets that the job is for a wire EDM machine.
    fn is_of_wire(&mut self);
    /// A code that threads or cuts the wire, drills its start hole or fills the tank.
    fn wire(&mut self, code: Coded);
    /// The current item of the job.
    fn place(&self) -> toolpath::Place;
    /// Sets the item that the next motions belong to.
    fn comes_from(&mut self, place: toolpath::Place);
}

/// Success, or the finding that ended the comparison.
pub(super) type Done<T = ()> = Result<T, Box<Diag>>;

/// A straight cut of the job that is not part of a hole and begins at a known position.
pub(super) struct Straight<'a> {
    pub from: &'a Place,
    pub to: &'a Place,
    pub feed: Option<f64>,
    pub mode: FeedMode,
    pub state: &'a Shared,
}

/// The requirements of the job for a hole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expected {
    /// The position above the hole.
    pub at: Place,
    /// The height where the feed begins.
    pub plane: f64,
    pub bottom: f64,
    pub dwell: Option<f64>,
    /// Whether the program may make the hole with other pecks.
    pub pecks: bool,
    /// Whether the tool leaves the hole between pecks. For a tap, a setting of the control decides whether the tool
    /// leaves the hole.
    pub comes_out: bool,
    /// Whether the job drills the hole in one stroke. The program may peck the hole even then.
    pub drilled_in_one: bool,
    /// Whether the hole is tapped. In a tapped hole, feed and speed define the pitch of the thread.
    pub is_tap: bool,
    /// Whether the tool may leave the hole at feed and end higher than in the job.
    pub feeds_out: bool,
    /// Whether only the form defines the moves in the hole (a custom cycle).
    pub custom: bool,
}

/// The requirements of the job for one start of a thread. X is a radius.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Threaded {
    /// The position, away from the thread, from which the tool moves to each pass.
    pub begin: Place,
    /// The Z of the end of the thread.
    pub end: f64,
    /// Radius of the thread's crest at the end of the thread.
    pub crest: f64,
    /// Radius at the beginning of a pass minus the radius at the end of the pass.
    pub taper: f64,
    /// -1 if the passes go deeper towards the axis, 1 if they go deeper away from the axis.
    pub inward: f64,
    /// Depth of each pass of the job below the crest of the thread.
    pub passes: Vec<f64>,
    /// Distance that the thread advances in one turn.
    pub lead: f64,
}

/// Fails with the reason why this part of the job can't be proven.
pub(super) fn unproven<T>(what: Unmodelled) -> Done<T> {
    Err(Box::new(
        Diag::new(Code::PV020, what.why())
            .help("docs/verify.md lists the cases that can't be proven; prove the rest as a separate job"),
    ))
}
