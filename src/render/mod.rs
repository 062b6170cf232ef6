//! From toolpath events to NC blocks (render.md): modality, tool changes, arcs, canned cycles.

mod arcs;
mod centres;
mod changes;
mod codes;
mod compensation;
mod cycles;
mod fault;
mod generated;
mod geometry;
mod holes;
mod measure;
mod motion;
mod move_sequences;
mod move_words;
mod output;
mod registers;
mod renderer;
mod rotary;
mod says;
mod sections;
mod start;
mod subprograms;
mod threads;
mod tools;
mod upon;
mod vars;
mod words;

pub use output::TraceLine;
pub use renderer::{Cycles, Options, Renderer};
pub use start::cycle_defaults;
