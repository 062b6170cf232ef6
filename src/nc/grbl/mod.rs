//! Grbl 1.1: what it reads, what it refuses, and what it does otherwise than the interpreter that it comes from.
//!
//! Observed from outside, by programs and the answers of its own parser. It finds all that is wrong with a block before
//! it does anything, so a refused block does nothing.

mod arcs;
mod check;
mod error;
mod run;
mod text;

pub(super) use text::read;
