//! Moves of the path, with one file for each kind of move.

pub mod arc;
mod centres;
pub mod compensation;
mod geometry;
pub mod line;
pub mod measure;
mod pieces;
mod plain;
pub mod prepare;
pub mod rapid;
pub mod rapid_blocks;
pub mod rotary;
pub mod threads;
pub mod travel;
