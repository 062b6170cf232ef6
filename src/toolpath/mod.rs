//! Toolpath events: what readers produce and the renderer consumes, one at a time.

mod dwell;
mod event;
mod hold;
mod kind;
mod order;
mod place;
mod read;
mod sink;
mod summary;

pub mod json;

pub use dwell::LastDwell;
pub use event::{
    Arc, Axes, Call, Coolant, CycleSpec, Direction, EdmAction, Event, FeedMode, First, Hole, Infeed, Orient, Peck,
    Plane, Section, Side, Spindle, SpindleTurn, Start, StopKind, Thread, Tool, ToolChange, Units,
};
pub use hold::Hold;
pub use kind::CycleKind;
pub use order::{Order, impossible};
pub use place::Place;
pub use read::ReadError;
pub use sink::{Flow, Sink, Stop, flow};
pub use summary::Summary;

/// A number as a key; zero has one sign.
pub(crate) fn key(number: f64) -> u64 {
    (number + 0.0).to_bits()
}
