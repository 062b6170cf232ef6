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
mod reader;
mod spec;
mod words;

pub use dialect::Dialect;
pub use reader::{Options, Report, read_cl};
