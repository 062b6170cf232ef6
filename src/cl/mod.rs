//! APT CL files: converts the cutter location file of a CAM system to toolpath events (docs/cl.md).

mod arcs;
mod coded;
mod cycle;
mod cycle_camplete;
mod cycle_dialects;
mod cycle_words;
mod dialect;
mod fault;
mod feed;
mod feed_unit;
mod holes;
mod ignored;
mod job;
mod lines;
mod load;
mod machine;
mod majors;
mod missing;
mod motion;
mod options;
mod reader;
mod report;
mod setup;
mod setups;
mod spec;
mod state;
mod texts;
mod tlon;
mod tools;
mod vector;
mod words;

pub use dialect::Dialect;
pub use options::{Assumed, AssumedSpeed, Options, parse_position};
pub use reader::{read_cl, setups};
pub use report::Report;
pub use setup::Setup;
