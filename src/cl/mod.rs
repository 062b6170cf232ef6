//! APT CL files: the statements of a CAM system's cutter location file as toolpath events (cl.md).

mod arcs;
mod coded;
mod cycle;
mod cycle_words;
mod dialect;
mod fault;
mod feed;
mod holes;
mod job;
mod lines;
mod load;
mod machine;
mod majors;
mod motion;
mod options;
mod reader;
mod report;
mod spec;
mod state;
mod texts;
mod tlon;
mod tools;
mod words;

pub use dialect::Dialect;
pub use options::{Assumed, Options};
pub use reader::read_cl;
pub use report::Report;
