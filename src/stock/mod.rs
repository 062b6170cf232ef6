//! Checks rapids against the stock: a block of material that the tools of a program cut. A rapid through the stock is a finding.
//!
//! The stock is a height field: a grid of cells in X and Y, each with one height. Such a grid can represent every shape
//! that a mill with three axes cuts from above. A program is run by the rules of its control. Each work offset has its
//! own copy of the stock, which the moves in this offset cut.

mod centre;
mod check;
mod field;
mod size;
mod sweep;

pub use check::{StockCheck, check_stock};
pub use size::Stock;
