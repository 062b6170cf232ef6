//! The stock: a block of material that the tools of a program cut. A rapid through it is a finding.
//!
//! The stock is a height field: each cell of a grid in X and Y has one height. This describes everything that a mill with
//! three axes cuts from above. A program is run by the rules of its control, and the moves in each work offset cut their own
//! block: the same stock is expected in each of them.

mod centre;
mod check;
mod field;
mod size;
mod sweep;

pub use check::{StockCheck, check_stock};
pub use size::Stock;
