//! Grbl 1.1: the blocks that Grbl reads and refuses, and how Grbl differs from its origin, the NIST interpreter.
//!
//! The behaviour of Grbl was found by sending programs to its parser and reading the answers. Grbl checks a whole block
//! before it runs any part of it, so a refused block has no effect.

mod arcs;
mod check;
mod error;
mod run;
mod text;

pub(super) use text::read;
