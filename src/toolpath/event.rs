//! The events of a toolpath. Readers push events, and the renderer converts events to blocks (docs/rendering.md).

use super::axes::Axes;
use super::cycle::{CycleSpec, Hole};
use super::moves::{Arc, Infeed, Section};
use super::operation::ToolChange;
use super::start::{Given, Start};
use super::thread::Thread;
use super::tool::Spindle;
use crate::lang::Coolant;

/// Kinds of stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopKind {
    /// The machine stops: M0.
    Program,
    /// The machine stops if the operator has turned on the optional stop: M1.
    Optional,
}

/// An action of a wire EDM machine between moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdmAction {
    /// The wire is threaded.
    Thread,
    /// The wire is cut.
    Cut,
    /// The start hole for the wire is drilled.
    PreDrill,
    /// The tank is filled.
    Submerge,
}

/// A call of a subprogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Call {
    /// The subprogram's number in the job.
    pub sub: f64,
    /// How often the subprogram runs.
    pub times: f64,
    /// Position of the tool at the call.
    pub at: Axes,
    /// Work offset of the call: a fixture number if below 50, otherwise a code.
    pub work: Option<f64>,
}

/// One event of a job. Readers push events, and sinks receive them.
#[derive(Clone, Debug)]
pub enum Event<'a> {
    /// The head of the job. The head is always the first event.
    Start(&'a Start),
    /// An operation begins.
    ToolChange(&'a ToolChange),
    /// A rapid move to a position.
    Rapid(Axes),
    /// A straight move at feed.
    Line {
        /// End of the move.
        to: Axes,
        /// The feed from this move on; `None`: unchanged.
        feed: Option<f64>,
    },
    /// An arc or helix at feed.
    Arc {
        /// End, centre and direction.
        arc: &'a Arc,
        /// The feed from this move on; `None`: unchanged.
        feed: Option<f64>,
    },
    /// A straight move that turns cutter compensation on.
    Infeed {
        /// End of the move, and side of the path.
        infeed: &'a Infeed,
        /// The feed from this move on; `None`: unchanged.
        feed: Option<f64>,
    },
    /// A straight move that turns cutter compensation off.
    Outfeed {
        /// End of the move.
        to: Axes,
        /// The feed from this move on; `None`: unchanged.
        feed: Option<f64>,
        /// Whether the move is a rapid.
        rapid: bool,
    },
    /// The tool axis from here on, as a unit vector. At the start of a job, the tool axis is 0, 0, 1.
    Tilt([f64; 3]),
    /// A named part of the path begins.
    Begin(Section),
    /// A named part of the path ends.
    End(Section),
    /// A canned cycle begins. Its holes follow.
    CycleBegin(&'a CycleSpec),
    /// A hole of the cycle.
    Hole(Hole),
    /// The canned cycle ends.
    CycleEnd,
    /// A dwell, in seconds.
    Dwell(f64),
    /// A stop of the program.
    Stop(StopKind),
    /// A comment to print.
    Comment(&'a str),
    /// Text that is printed without changes.
    Text(&'a str),
    /// The feed from here on, in the feed mode of the operation.
    Feed(f64),
    /// The work offset from here on: a fixture number if below 50, otherwise a code.
    Work(f64),
    /// The state of the spindle from here on.
    Spindle(Spindle),
    /// The coolant from here on.
    Coolant(Coolant),
    /// The tool goes home, to the machine position that the form defines (MoveHome).
    Home,
    /// A variable or property of the form, by its name, and its value from here on.
    Set(&'a str, &'a Given),
    /// The subprogram with this number begins.
    SubStart(f64),
    /// The open subprogram ends.
    SubEnd,
    /// A call of a subprogram.
    SubCall(&'a Call),
    /// A thread on a lathe.
    Thread(&'a Thread),
    /// An action of a wire EDM machine.
    Edm(EdmAction),
    /// The job ends. `Finish` is always the last event.
    Finish,
}

impl Event<'_> {
    /// The position to which the event moves the tool.
    pub(crate) fn target(&self) -> Option<Axes> {
        match self {
            Event::Rapid(to) | Event::Line { to, .. } | Event::Outfeed { to, .. } => Some(*to),
            Event::Arc { arc, .. } => Some(arc.to),
            Event::Infeed { infeed, .. } => Some(infeed.to),
            Event::Hole(hole) => Some(hole.at),
            _ => None,
        }
    }

    /// Whether the tool moves to a position, or a subprogram that may move the tool is called.
    pub(crate) fn moves(&self) -> bool {
        matches!(
            self,
            Event::Rapid(_)
                | Event::Line { .. }
                | Event::Arc { .. }
                | Event::Infeed { .. }
                | Event::Outfeed { .. }
                | Event::Hole(_)
                | Event::Thread(_)
                | Event::SubCall(_)
        )
    }
}
