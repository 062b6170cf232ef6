//! Checks whether a program fits into its machine: travels, fixtures, feeds, tools, offsets, memory.
//!
//! A machine position is the sum of the program position, the work offset, the shift of G52 or G92, and the tool length
//! if one is active. Nothing is added to a position in machine coordinates. A position that depends on an unknown
//! offset or length is stored relative to this offset or length.

mod check;
mod clock;
mod extent;
mod feeds;
mod fit;
mod fitted;
mod place;
mod run;
mod travel;

pub use clock::Times;
pub use fit::Fit;
pub use fitted::{Fitted, JobTool, Known};
pub use run::{preflight, preflight_by_block};
