//! The planner, which converts canned cycles to motions. The planner calculates the steps from the parameters of the
//! cycle only.

mod bore;
mod check;
mod pecks;
mod plan;
mod problem;
mod steps;
mod tap;
mod thread;

pub use check::check;
pub use pecks::stepped_pecks;
pub use plan::{Defaults, Plan, Step, rounded};
pub use steps::{Steps, plan};
pub use thread::thread_passes;
