//! What is done with programs: prove, compare, run them.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::controls::length;
use super::{ControlArgs, MachineArg, ReadArgs, RenderOptions, UnitsArg};

/// How a verdict is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum VerifyFormat {
    /// A sentence; findings on standard error
    Text,
    /// One JSON document
    Json,
}

/// `postform verify`.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// The job, or - for standard input; or several jobs, or folders of jobs
    #[arg(required = true, value_name = "JOB")]
    pub jobs: Vec<PathBuf>,
    /// The form that prints the program; with --nc, what it says of the job's defaults
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// A program that is there already
    #[arg(long, value_name = "NC")]
    pub nc: Option<PathBuf>,
    /// How near places must be, in the job's units [default: 0.0001 inch, 0.002 mm]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub tolerance: Option<f64>,
    /// How the verdict is shown
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: VerifyFormat,
    /// How many of several jobs are verified at a time [default: one a core]
    #[arg(long = "jobs", value_name = "N")]
    pub at_a_time: Option<NonZeroUsize>,
    /// How the program is run
    #[command(flatten)]
    pub control: ControlArgs,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// How it is rendered
    #[command(flatten)]
    pub options: RenderOptions,
    /// How the job is read
    #[command(flatten)]
    pub read: ReadArgs,
}

/// How the motions of a program are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MotionFormat {
    /// A line an action
    Text,
    /// JSON Lines
    Json,
}

/// Where a run begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StartArg {
    /// At 0 on all axes, as rs274 does
    Zero,
    /// Where only the machine knows: what depends on that is shown as `?`, in JSON as null
    Unknown,
}

/// `postform simulate`.
#[derive(Debug, Args)]
pub struct SimulateArgs {
    /// The NC program, or - for standard input
    pub program: PathBuf,
    /// Where the tool is at the beginning, and its height after a tool change
    #[arg(long, value_name = "PLACE", default_value = "zero")]
    pub start: StartArg,
    /// How it is run
    #[command(flatten)]
    pub control: ControlArgs,
    /// Units before the first G20 or G21
    #[arg(long, value_name = "UNITS", default_value = "mm")]
    pub units: UnitsArg,
    /// How motions are shown
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: MotionFormat,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// Only count: blocks, moves, holes, extents, distances, time
    #[arg(long)]
    pub dry: bool,
}

/// How a comparison is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DiffFormat {
    /// Unified, or side by side on a wide terminal, with changed words marked
    Text,
    /// One JSON document
    Json,
    /// A page that stands alone
    Html,
}

/// How blocks of both programs are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Layout {
    /// Side by side where the terminal has 140 columns or more
    Auto,
    /// One below the other
    Unified,
    /// Side by side
    Side,
}

/// `postform diff`.
#[derive(Debug, Args)]
pub struct DiffArgs {
    /// OLD and NEW program; with --form the JOB; with --forms OLD.pf, NEW.pf and the JOB, or several jobs or folders of jobs
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// What does not count, of numbers, comments, spaces, case, format, order, all, none
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_value = "numbers,spaces,case,format")]
    pub ignore: Vec<String>,
    /// By how much numbers may differ and be the same
    #[arg(long, value_name = "NUMBER", value_parser = length, default_value = "0")]
    pub tolerance: f64,
    /// Compare what the machine does, not what is written
    #[arg(long)]
    pub motion: bool,
    /// Unchanged blocks around changed ones
    #[arg(long, value_name = "BLOCKS", default_value_t = 3)]
    pub context: usize,
    /// How the comparison is shown
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: DiffFormat,
    /// How text is laid out
    #[arg(long, value_name = "LAYOUT", default_value = "auto")]
    pub layout: Layout,
    /// Print the JOB with this form, and compare it with --against
    #[arg(long, value_name = "FORM", requires = "against", conflicts_with = "forms")]
    pub form: Option<PathBuf>,
    /// The program of before
    #[arg(long, value_name = "OLD", requires = "form")]
    pub against: Option<PathBuf>,
    /// Print the JOB with both forms, and compare
    #[arg(long)]
    pub forms: bool,
    /// How programs are run for --motion
    #[command(flatten)]
    pub control: ControlArgs,
    /// How jobs are rendered
    #[command(flatten)]
    pub options: RenderOptions,
    /// How jobs are read
    #[command(flatten)]
    pub read: ReadArgs,
}
