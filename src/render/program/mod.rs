//! The program around the path: begin, end, operations, parts of a path, text, and subprograms.

pub mod calls;
pub mod comments;
pub mod finish;
pub mod home;
pub mod sections;
pub mod start;
pub mod stops;
pub mod subprograms;
pub mod table;
pub mod text;
pub mod tools;
pub mod variables;
