//! **postform**: the compiler for POSTFORM files.
//!
//! A form is text; [`syntax`] reads it, [`sema`] checks it against the vocabulary of [`lang`], [`compile`] makes a flat
//! program of it, and [`render`] runs that program over [`toolpath`] events to print the blocks of an NC program.
//! The library does no I/O of its own: files, the terminal and the command line are in the binary.
#![forbid(unsafe_code)]
#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::todo, clippy::dbg_macro)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

pub mod cl;
pub mod compile;
pub mod control;
pub mod cycle;
pub mod diag;
pub mod diff;
pub mod explain;
pub mod fmt;
pub mod lang;
pub mod lint;
pub mod nc;
pub mod number;
pub mod render;
pub mod sema;
pub mod source;
pub mod span;
pub mod syntax;
pub mod toolpath;
pub mod trace;
pub mod verify;
