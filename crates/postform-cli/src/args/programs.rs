//! Commands for programs: verify, simulate, diff.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use postform::internals::preflight::Stock;

use super::controls::length;
use super::{ControlArgs, MachineArg, ReadArgs, RenderOptions, UnitsArg};

/// The output format of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum VerifyFormat {
    /// The verdict as one sentence, and findings on standard error
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
    /// The form that prints the program; with --nc, the form that supplies default values of the job
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// Verify this program instead of printing one
    #[arg(long, value_name = "NC")]
    pub nc: Option<PathBuf>,
    /// Largest allowed difference of positions, in the job's units [default: 0.0001 inch, 0.002 mm]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub tolerance: Option<f64>,
    /// Output format of the verdict
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: VerifyFormat,
    /// Also report rapids through this stock, a block in the work offset, in the job's units, such as "X0..100 Y0..60 Z-20..0"
    #[arg(long, value_name = "BLOCK", allow_hyphen_values = true)]
    pub stock: Option<Stock>,
    /// Number of jobs that are verified at the same time [default: one per core]
    #[arg(long = "jobs", value_name = "N")]
    pub at_a_time: Option<NonZeroUsize>,
    /// Options for simulating the program
    #[command(flatten)]
    pub control: ControlArgs,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// Options for rendering
    #[command(flatten)]
    pub options: RenderOptions,
    /// Options for reading the job
    #[command(flatten)]
    pub read: ReadArgs,
}

/// The output format of motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MotionFormat {
    /// One line per action
    Text,
    /// JSON Lines
    Json,
}

/// The position at the start of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StartArg {
    /// At 0 on all axes, as rs274 does
    Zero,
    /// At an unknown position: values that depend on it are shown as `?`, in JSON as null
    Unknown,
}

/// `postform simulate`.
#[derive(Debug, Args)]
pub struct SimulateArgs {
    /// The NC program, or - for standard input
    pub program: PathBuf,
    /// Position of the tool at the start of the program, and its height after each tool change
    #[arg(long, value_name = "PLACE", default_value = "zero")]
    pub start: StartArg,
    /// Options for simulating the program
    #[command(flatten)]
    pub control: ControlArgs,
    /// Units before the first G20 or G21 [default: mm]
    #[arg(long, value_name = "UNITS")]
    pub units: Option<UnitsArg>,
    /// Output format of the motions
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: MotionFormat,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// Print only totals: blocks, moves, holes, extents, distances, time
    #[arg(long)]
    pub dry: bool,
}

/// The output format of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DiffFormat {
    /// One below the other, or side by side on a wide terminal, with changed words marked
    Text,
    /// One JSON document
    Json,
    /// A web page that needs no other files
    Html,
}

/// The layout of the blocks of both programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Layout {
    /// Side by side if the terminal has 140 columns or more
    Auto,
    /// One below the other
    Unified,
    /// Side by side
    Side,
}

/// `postform diff`.
#[derive(Debug, Args)]
pub struct DiffArgs {
    /// The programs OLD and NEW; with --form: the JOB; with --forms: the forms OLD.pf and NEW.pf, then jobs or folders of jobs
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Differences to ignore: numbers, comments, spaces, case, format, points, order, all, none
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_value = "numbers,spaces,case,format")]
    pub ignore: Vec<String>,
    /// Treat numbers as equal if they differ by no more than this
    #[arg(long, value_name = "NUMBER", value_parser = length, default_value = "0")]
    pub tolerance: f64,
    /// Compare the motions of the machine instead of the text
    #[arg(long)]
    pub motion: bool,
    /// Number of unchanged blocks to show around each change
    #[arg(long, value_name = "BLOCKS", default_value_t = 3)]
    pub context: usize,
    /// Output format of the comparison
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: DiffFormat,
    /// Layout of the text
    #[arg(long, value_name = "LAYOUT", default_value = "auto")]
    pub layout: Layout,
    /// Print the JOB with this form, and compare the program with --against
    #[arg(long, value_name = "FORM", requires = "against", conflicts_with = "forms")]
    pub form: Option<PathBuf>,
    /// The old program, for --form
    #[arg(long, value_name = "OLD", requires = "form")]
    pub against: Option<PathBuf>,
    /// Print each job with both forms, and compare the two programs
    #[arg(long)]
    pub forms: bool,
    /// Options for simulating programs with --motion
    #[command(flatten)]
    pub control: ControlArgs,
    /// Options for rendering jobs
    #[command(flatten)]
    pub options: RenderOptions,
    /// Options for reading jobs
    #[command(flatten)]
    pub read: ReadArgs,
}
