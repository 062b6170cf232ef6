//! Canned cycles as motions: one planner, a pure function from parameters to steps.

mod pecks;
mod plan;

pub use plan::{Defaults, Plan, Problem, Step, Steps, plan};
