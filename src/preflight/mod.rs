//! Does a program fit into its machine: travels, fixtures, feeds, tools, offsets, memory.
//!
//! A machine position is the program position plus the work offset, the shift of G52 or G92, and the tool length while that is
//! on; in machine coordinates nothing is added. What depends on an offset or a length that is not known is kept as an interval.

mod check;
mod clock;
mod extent;
mod fit;
mod place;
mod travel;

pub use check::{Fitted, JobTool, preflight};
pub use clock::Times;
pub use fit::Fit;
