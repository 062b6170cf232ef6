//! NC programs: scanned as bytes, run by the rules of a control.
//!
//! Rules of LinuxCNC were observed from outside (nc.md in the specification); those of Fanuc and Haas are the usual
//! reading of their manuals.

mod action;
mod arcs;
mod block;
mod bodies;
mod codes;
mod cycles;
mod expression;
mod fanuc_cycles;
mod fault;
mod flow;
mod frames;
mod grbl;
mod job;
mod jumps;
mod machine;
mod modes;
mod motion;
mod offsets;
mod parameters;
mod scan;
mod simulator;
mod tally;
mod thread;

pub use action::{Action, Cooling, Drilling, Item, Position, Rotation, Turn};
pub(crate) use arcs::axes_of;
pub use job::{JobOptions, read_program};
pub use machine::{Machine, Settings, Unpointed};
pub use scan::{Kind, Number, Token, Tokens, tokens};
pub use simulator::{RunError, Simulator};
pub use tally::Tally;
pub(crate) use tally::sweep;
