//! Checks whether a program fits into its machine: travels, fixtures, feeds, tools, offsets, memory.
//!
//! A machine position is the program position plus the work offset, the shift of G52 or G92, and the tool length if one is
//! active. In machine coordinates nothing is added. A position that depends on an unknown offset or length is kept as an
//! interval.

mod check;
mod clock;
mod extent;
mod fit;
mod place;
mod travel;

pub use check::{Fitted, JobTool, preflight};
pub use clock::Times;
pub use fit::Fit;
