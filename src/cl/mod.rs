//! APT CL files: the statements of a CAM system's cutter location file as toolpath events (cl.md).

mod arcs;
mod coded;
mod cycle;
mod cycle_words;
mod dialect;
mod lines;
mod machine;
mod majors;
mod motion;
mod paths;
mod reader;
mod spec;
mod texts;
mod words;

pub use dialect::Dialect;
pub use paths::Assumed;
pub use reader::{Options, Report, read_cl};
