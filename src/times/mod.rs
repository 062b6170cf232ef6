//! The time of moves on axes that accelerate. The speed along the path has a trapezoidal profile and is planned ahead
//! over the next blocks.
//!
//! Linear travel is in millimetres, rotary travel is in degrees, and times are in seconds.

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
