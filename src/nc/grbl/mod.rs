//! Grbl 1.1: the blocks that it reads and refuses, and its differences from the interpreter that it derives from.
//!
//! Its behaviour was observed from outside, by programs and the answers of its own parser. Grbl checks the whole block
//! before it runs any of it, so a refused block has no effect.

mod arcs;
mod check;
mod error;
mod run;
mod text;

pub(super) use text::read;
