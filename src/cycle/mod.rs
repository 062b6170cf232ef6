//! Canned cycles as motions: one planner, a pure function from parameters to steps.

mod pecks;
mod plan;
mod thread;

pub use plan::{Defaults, Plan, Problem, Step, Steps, plan};
pub use thread::thread_passes;
