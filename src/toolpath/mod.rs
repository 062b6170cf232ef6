//! Toolpath events. Readers of jobs produce events one at a time, and sinks such as the renderer process the events.

mod axes;
mod cuts;
mod cycle;
mod dwell;
mod event;
mod hold;
mod job_axes;
pub(crate) mod kept;
mod kind;
mod moves;
mod operation;
mod order;
mod place;
mod plane_arc;
mod read;
mod sink;
mod start;
mod summary;
mod thread;
mod tool;

pub(crate) mod json;

pub use axes::{Axes, Units};
pub(crate) use cuts::Cuts;
pub(crate) use cycle::MOST_PECKS;
pub use cycle::{CycleSpec, Hole, Orient, Peck};
pub(crate) use dwell::LastDwell;
pub use event::{Call, EdmAction, Event, StopKind};
pub(crate) use hold::Hold;
pub(crate) use job_axes::JobAxes;
pub(crate) use kept::Kept;
pub use kind::CycleKind;
pub use moves::{Arc, Direction, Infeed, Plane, Section, Side};
pub use operation::{First, ToolChange};
pub(crate) use order::{Order, impossible};
pub use place::Place;
pub(crate) use plane_arc::PlaneArc;
pub use read::ReadError;
pub use sink::{Flow, Sink, Stop, flow};
pub use start::{About, Given, Start};
pub use summary::Summary;
pub use thread::Thread;
pub use tool::{Coolant, FeedMode, Spindle, SpindleTurn, Tool};

/// A number as the key of a map. 0 and -0 have the same key.
pub(crate) fn key(number: f64) -> u64 {
    (number + 0.0).to_bits()
}
