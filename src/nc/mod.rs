//! NC programs are read as bytes and run by the rules of a control.
//!
//! The rules of LinuxCNC were found by running programs on its interpreter. The rules of Fanuc and Haas follow the
//! usual interpretation of their manuals.

mod action;
mod arcs;
mod before;
mod block;
mod bodies;
mod call;
mod codes;
mod cycles;
mod digits;
mod expression;
mod fanuc_cycles;
mod fault;
mod flow;
mod foreign;
mod frames;
mod grbl;
mod holes;
mod job;
mod json;
mod jumps;
mod languages;
mod lathe;
mod modal;
mod modes;
mod motion;
mod offsets;
mod out;
mod pace;
mod parameters;
mod place;
mod plain;
mod profiled;
mod read;
mod rotary;
mod run;
mod scan;
mod settings;
mod simulator;
mod standing;
mod state;
mod stops;
mod tally;
mod thread;
mod tool;
mod tool_names;
mod turning;
mod way;

pub use action::{Action, Cooling, Drilling, Item, Position, Rotation, Threading, Turn};
pub(crate) use arcs::axes_of;
pub use foreign::{control_of_name, settings_for};
pub use job::{JobOptions, read_program};
pub use json::{json_line, plane_name, stop_name, turn_name};
pub use modal::Modal;
pub use pace::Pace;
pub use scan::{Kind, Token, tokens};
pub use settings::{RunSettings, Unpointed};
pub use simulator::{RunError, Simulator};
pub use standing::Standing;
pub use tally::Tally;
pub(crate) use tally::sweep;
pub use tally::{clock, rapid_rate};
pub(crate) use tool::{cooling as cooling_of, rotation as rotation_of};
pub(crate) use tool_names::FIRST as FIRST_NAMED_TOOL;
