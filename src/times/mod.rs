//! The time of moves on axes that accelerate: trapezoids of speed along the path, planned ahead over the next blocks.
//!
//! Lengths are millimetres and degrees, times are seconds.

mod corner;
mod curve;
mod deviation;
mod leg;
mod linuxcnc;
mod planner;
mod queue;
mod rates;

pub use corner::{Corner, PathMode};
pub use curve::Curve;
pub use planner::Planner;
pub use queue::BlockTime;
pub use rates::{AxisRates, Rates, Way};
