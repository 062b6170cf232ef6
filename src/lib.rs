//! **postform**: the compiler for POSTFORM files, the templates of CNC post processors.
//!
//! A form says how one machine wants its NC code. Compile it once, print any number of jobs with it, and have each program
//! proven:
//!
//! ```
//! use postform::{Job, NoFiles, Options, Post, Source};
//!
//! const FORM: &str = include_str!("../postforms/haas.pf");
//! const JOB: &str = include_str!("../samples/bracket/job.json");
//!
//! # fn main() -> Result<(), postform::Error> {
//! let post = Post::compile(Source::from_text("haas.pf", FORM), &NoFiles)?;
//! let program = post.render(Job::json(JOB), &Options::default())?;
//! assert!(program.text().starts_with("%\nO"));
//! assert!(program.verdict().is_proven());
//! # Ok(())
//! # }
//! ```
//!
//! - [`Post`] owns its form; a clone shares it, also with other threads. A form with errors makes no post.
//! - [`Job`] is what is to be made: JSON, JSON Lines, a CL file, an NC program, or events of your own.
//! - [`Program`] is whole: what can't be printed is an [`Error`] with its findings, and never half a program.
//! - [`Verdict`] says whether a program makes the motions of its job. One that makes others is an [`Error`], too.
//!
//! A form is text; [`syntax`] reads it, [`sema`] checks it against the vocabulary of [`lang`], [`compile`] makes a flat
//! program of it, and [`render`] runs that program over [`toolpath`] events to print the blocks of an NC program.
//! The library does no I/O of its own: bytes and names come in. Files, the terminal and the command line are in the binary,
//! which the feature `cli` builds; the library alone needs `default-features = false`.
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr, clippy::disallowed_methods, clippy::disallowed_types)]

pub mod cl;
pub mod compile;
pub mod control;
pub mod cycle;
pub mod diag;
pub mod diff;
pub mod error;
pub mod explain;
pub mod fmt;
#[cfg(feature = "freecad")]
pub mod freecad;
pub mod ide;
pub mod job;
pub mod lang;
pub mod lint;
pub mod nc;
pub mod number;
pub mod picture;
pub mod post;
pub mod render;
#[cfg(feature = "json")]
pub mod report;
pub mod scene;
pub mod sema;
pub mod source;
pub mod span;
pub mod syntax;
pub mod toolpath;
pub mod trace;
pub mod verify;

pub use diag::{Diag, Findings};
pub use error::{Error, ErrorKind};
pub use job::{Format, Job, Reading};
pub use post::{Files, NoFiles, Options, Part, Post, Program, Prompt, Proof, Proven, Rendered};
pub use source::Source;
pub use verify::Verdict;
