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
//! - [`toolpath`] has the events of a job, for readers of your own; [`diag`] has the findings, with their codes.
//!
//! The library does no I/O of its own: bytes and names come in. Files, the terminal and the command line are in the package
//! `postform-cli`. The feature `freecad` reads FreeCAD documents as jobs.
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr, clippy::disallowed_methods, clippy::disallowed_types)]

mod cl;
mod compile;
mod config;
mod control;
mod cycle;
pub mod diag;
mod diff;
mod error;
mod explain;
mod fmt;
#[cfg(feature = "freecad")]
mod freecad;
mod ide;
mod job;
mod lang;
mod lint;
mod nc;
mod number;
mod picture;
mod post;
mod render;
mod report;
mod scene;
mod sema;
mod source;
mod span;
mod survey;
mod syntax;
mod terminal;
pub mod toolpath;
mod trace;
mod verify;

// what is public besides these two modules: tests/data/public-items.txt lists it all
pub use cl::{Assumed, AssumedSpeed, Dialect, Options as ClOptions, Report as ClReport, Setup as ClSetup};
pub use config::{Config, ControlName};
pub use control::{Control, Wrong as WrongControl};
pub use diag::{Diag, Findings};
pub use error::{Error, ErrorKind};
pub use explain::explain;
pub use fmt::format;
#[cfg(feature = "freecad")]
pub use freecad::Options as FreecadOptions;
pub use job::{Format, Job, Reading};
pub use lang::{Machine, SequenceId, VarId};
pub use lint::{Level, Levels};
pub use nc::{JobOptions as NcOptions, RunSettings, Unpointed};
pub use post::{Files, NoFiles, Options, Part, Post, Program, Prompt, Proof, Proven, Rendered};
pub use render::{Clock, Cycles, TraceLine};
pub use sema::{Limits, Property};
pub use source::Source;
pub use span::Span;
pub use verify::{Batch, Counts, Equivalences, Finding, Unproven, Verdict};

/// What the command line, the tests and the benchmarks of this repository use besides the front door. It is no part of the
/// public library, and changes without notice.
#[doc(hidden)]
pub mod internals {
    pub mod cl {
        pub use crate::cl::*;
    }
    pub mod compile {
        pub use crate::compile::*;
    }
    pub mod control {
        pub use crate::control::*;
    }
    pub mod cycle {
        pub use crate::cycle::*;
    }
    pub mod diff {
        pub use crate::diff::*;
    }
    pub mod explain {
        pub use crate::explain::*;
    }
    pub mod fmt {
        pub use crate::fmt::*;
    }
    #[cfg(feature = "freecad")]
    pub mod freecad {
        pub use crate::freecad::*;
    }
    pub mod ide {
        pub use crate::ide::*;
    }
    pub mod lang {
        pub use crate::lang::*;
    }
    pub mod lint {
        pub use crate::lint::*;
    }
    pub mod nc {
        pub use crate::nc::*;
    }
    pub mod number {
        pub use crate::number::*;
    }
    pub mod picture {
        pub use crate::picture::*;
    }
    pub mod post {
        pub use crate::post::*;
    }
    pub mod render {
        pub use crate::render::*;
    }
    pub mod report {
        pub use crate::report::*;
    }
    pub mod scene {
        pub use crate::scene::*;
    }
    pub mod sema {
        pub use crate::sema::*;
    }
    pub mod source {
        pub use crate::source::*;
    }
    pub mod survey {
        pub use crate::survey::*;
    }
    pub mod syntax {
        pub use crate::syntax::*;
    }
    pub mod terminal {
        pub use crate::terminal::*;
    }
    pub mod trace {
        pub use crate::trace::*;
    }
    pub mod verify {
        pub use crate::verify::*;
    }
    pub mod json {
        pub use crate::toolpath::json::*;
    }
}
