//! **postform**: the compiler for POSTFORM files, the templates of CNC post processors.
//!
//! A form describes the NC code of one machine. Compile it once and print any number of jobs with it. Each program is proven:
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
//! - [`Post`] owns its form. Clones share the form, also between threads. A form with errors makes no post.
//! - [`Job`] is the work to be machined: JSON, JSON Lines, a CL file, an NC program, or events of your own.
//! - [`Program`] is always complete: if something can't be printed, the result is an [`Error`] with its findings.
//! - [`Verdict`] states whether a program makes the motions of its job. A program with other motions is an [`Error`], too.
//! - [`toolpath`] has the events of a job, for readers of your own; [`diag`] has the findings, with their codes.
//!
//! The library does no I/O of its own: the caller passes bytes and names. Files, the terminal and the command line are in the package
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
mod machine;
mod nc;
mod nci;
mod number;
mod picture;
mod post;
mod preflight;
mod remarks;
mod render;
mod report;
mod restart;
mod scene;
mod sema;
mod setup;
mod source;
mod span;
mod stock;
mod suggest;
mod survey;
mod syntax;
mod terminal;
mod times;
pub mod toolpath;
mod trace;
mod verify;

// tests/data/public-items.txt lists everything that is public besides these two modules
pub use cl::{Assumed, AssumedSpeed, Dialect, Options as ClOptions, Report as ClReport, Setup as ClSetup};
pub use config::{Config, ControlName};
pub use control::{Control, Wrong as WrongControl};
pub use diag::{Diag, Findings};
pub use error::{Error, ErrorKind};
pub use explain::explain;
pub use fmt::format;
#[cfg(feature = "freecad")]
pub use freecad::Options as FreecadOptions;
pub use job::{Format, Job, Reading, Selection};
pub use lang::{Machine, SequenceId, VarId};
pub use lint::{Level, Levels};
pub use nc::{JobOptions as NcOptions, RunSettings, Unpointed};
pub use post::{Files, NoFiles, Options, Post, Program, Prompt, Proof, Proven, Rendered};
pub use render::{Clock, Cycles, TraceLine};
pub use sema::{Limits, Property};
pub use source::Source;
pub use span::Span;
pub use verify::{Counts, Equivalences, Finding, Unproven, UnprovenKind, Verdict};

/// Items for the command line, the tests and the benchmarks of this repository. These items are not part of the public
/// library and change without notice.
#[doc(hidden)]
pub mod internals {
    pub mod cl {
        pub use crate::cl::{Assumed, AssumedSpeed, Dialect, Options, Report, Setup, parse_position, read_cl, setups};
    }
    pub mod compile {
        pub use crate::compile::{Program, compile};
    }
    pub mod control {
        pub use crate::control::{Code, Control, Kept, Meaning, WithoutPoint, is_file, names};
    }
    pub mod cycle {
        pub use crate::cycle::{stepped_pecks, thread_passes};
    }
    pub mod diff {
        pub use crate::diff::{Comparison, Edit, Hunk, Ignore, Options, Program, Summary, changed_spans, compare};
    }
    pub mod explain {
        pub use crate::explain::{controls, explain, list, reference};
    }
    pub mod fmt {
        pub use crate::fmt::format;
    }
    #[cfg(feature = "freecad")]
    pub mod freecad {
        pub use crate::freecad::{Options, Report, read_freecad};
    }
    pub mod ide {
        pub use crate::ide::{
            Action, ActionKind, Completion, CompletionKind, Current, Document, Hint, Symbol, SymbolKind, TokenKind,
            about, program, symbols_of, utf16,
        };
    }
    pub mod lang {
        pub use crate::lang::{COMMANDS, CommandId, Machine, SEQUENCES, SequenceId, UnitChoice, VARIABLES};
        pub use crate::suggest::did_you_mean;
    }
    pub mod lint {
        pub use crate::lint::{Changed, Fixed, Found, Level, Levels, RULES, fix, lint, parts};
    }
    pub mod machine {
        pub use crate::machine::{Beside, Machine, read, summary, template};
        pub use crate::times::{AxisRates, Corner, Planner, Rates};
    }
    pub mod nc {
        pub use crate::nc::{
            Action, Item, JobOptions, Kind, Position, Rotation, RunError, RunSettings, Simulator, Tally, Turn,
            Unpointed, clock, control_of_name, json_line, plane_name, rapid_rate, read_program, settings_for,
            stop_name, tokens, turn_name,
        };
    }
    pub mod number {
        pub use crate::number::{
            Digits, Lead, LetterFormat, Point, Printing, Sign, decimal, quantise, short_decimal, write_number,
        };
    }
    pub mod picture {
        pub use crate::picture::{Kind, Picture, Register, Sheet, View, draw, svg, svg_over};
    }
    pub mod post {
        pub use crate::job::KeptJob;
        pub use crate::post::reading::taken;
        pub use crate::post::{Part, sample_job, sample_program, shipped};
    }
    pub mod preflight {
        pub use crate::preflight::{Fit, Fitted, JobTool, Known, Times, preflight, preflight_by_block};
        pub use crate::stock::{Stock, StockCheck, check_stock};
    }
    pub mod render {
        pub use crate::render::{Clock, Cycles, Options, Renderer, TraceLine, survey_terms};
    }
    pub mod report {
        pub use crate::report::{Row, finding, github, github_property, github_text, json, proof, row, sarif};
    }
    pub mod restart {
        pub use crate::restart::{Asked, Refused, Restarted, Target, restart};
    }
    pub mod scene {
        pub use crate::scene::{
            At, PLOT_PAGE, Printed, Ready, Request, Scene, WATCH_PAGE, behind, drawn, help, no_machine, of_program,
            prepare, program_of, scene,
        };
    }
    pub mod sema {
        pub use crate::sema::{Checked, Limits, MOST_TEXT, PropertyKind, PropertyValue, analyse, one_post};
    }
    pub mod setup {
        pub use crate::setup::{SetupSheet, html, markdown};
    }
    pub mod source {
        pub use crate::source::{Source, text_of};
    }
    pub mod survey {
        pub use crate::survey::Surveyor;
    }
    pub mod syntax {
        pub use crate::syntax::{Form, Head, Statement, Tail, parse};
    }
    pub mod terminal {
        pub use crate::terminal::{escaped, escaped_lines, steers, without_markup};
    }
    pub mod trace {
        pub use crate::trace::Trace;
    }
    pub mod verify {
        pub use crate::toolpath::kept::Kept;
        pub use crate::verify::{
            Batch, Comparer, Equivalences, Expectation, Finding, Motions, NoMotion, UNPROVEN, Verdict, compare_motions,
            prove_beside, tolerances,
        };
    }
    pub mod json {
        #[cfg(feature = "schema")]
        pub use crate::toolpath::json::schema;
        pub use crate::toolpath::json::{SCHEMA, read_document, read_lines};
    }
}
