//! From toolpath events to NC blocks (render.md): modality, tool changes, arcs, canned cycles.

mod arcs;
mod centres;
mod changes;
mod codes;
mod compensation;
mod cycles;
mod defaults;
mod fault;
mod generated;
mod geometry;
mod holes;
mod measure;
mod motion;
mod move_sequences;
mod move_words;
mod numbers;
mod options;
mod printer;
mod registers;
mod renderer;
mod rotary;
mod says;
mod sections;
mod shape;
mod start;
mod subprograms;
mod threads;
mod tools;
mod upon;
mod vars;
mod words;

pub use defaults::cycle_defaults;
pub use options::{Cycles, Options};
pub use printer::TraceLine;
pub use renderer::Renderer;
