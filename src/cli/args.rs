//! What can be typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use postform::cl::Dialect;
use postform::nc::{Control, Settings, Unpointed};
use postform::toolpath::Units;

use super::colour::Colour;

/// The compiler for POSTFORM files: NC programs from toolpaths, by a template of your machine's code.
#[derive(Debug, Parser)]
#[command(name = "postform", version, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// When to use colour
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub color: Colour,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Print the NC program of a job
    Render(RenderArgs),
    /// Report every finding of every form
    Lint(LintArgs),
    /// Read a job, report what is wrong, and print what is in it
    Check(CheckArgs),
    /// Prove that a program makes the motions of its job
    Verify(VerifyArgs),
    /// Show what changed between two NC programs
    Diff(DiffArgs),
    /// Run an NC program and print what the machine does
    Simulate(SimulateArgs),
    /// Write forms in the canonical layout
    Fmt(FmtArgs),
    /// Say what a code, command, variable, sequence or cycle means
    Explain(ExplainArgs),
    /// Write a commented form to start from
    New(NewArgs),
    /// Print the completions of a shell
    Completions(CompletionsArgs),
    /// Print the man page
    Man,
}

/// A file by its format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum From {
    /// One JSON document
    Json,
    /// JSON Lines
    Jsonl,
    /// An APT CL file
    Cl,
    /// An NC program
    Nc,
}

/// How a job is read.
#[derive(Debug, Default, Args)]
pub struct ReadArgs {
    /// The job's format [default: by its extension]
    #[arg(long, value_name = "FORMAT")]
    pub from: Option<From>,
    /// Who wrote a CL file: gener, catia, creo, nx, solidworks, makino, ncl [default: by its first lines]
    #[arg(long, value_name = "SYSTEM", value_parser = Dialect::parse)]
    pub dialect: Option<Dialect>,
    /// Units of a CL file or program that does not say them
    #[arg(long, value_name = "UNITS")]
    pub assume_units: Option<UnitsArg>,
    /// Tool number of a CL file or program that loads none
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(..=99_999_999))]
    pub assume_tool: Option<u32>,
    /// Whose rules a job that is an NC program follows [default: fanuc]
    #[arg(long, value_name = "CONTROL")]
    pub job_control: Option<ControlArg>,
    /// What a length without a point means in a job that is an NC program [default: it is an error]
    #[arg(long, value_name = "MEANING")]
    pub job_no_point: Option<NoPoint>,
}

/// Classic or extended limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LimitsArg {
    #[default]
    /// 15 words a line, 150 lines a form
    Classic,
    /// The same as warnings
    Extended,
}

/// Where cycles come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CyclesArg {
    /// The form's sequences
    Form,
    /// Single moves
    Emulated,
}

/// How deep a countersink of a diameter and an angle is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SinkArg {
    /// Half the diameter over the tangent of half the angle
    Geometry,
    /// Half the diameter times that tangent, as GENER's manual prints it: the same at 90 degrees only
    Printed,
}

/// Units of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UnitsArg {
    /// Inches
    Inch,
    /// Millimetres
    Mm,
}

impl UnitsArg {
    /// As the library has it.
    pub fn units(self) -> Units {
        match self {
            UnitsArg::Inch => Units::Inch,
            UnitsArg::Mm => Units::Mm,
        }
    }
}

/// How a job is rendered with a form.
#[derive(Debug, Args)]
pub struct RenderOptions {
    /// The program's number [default: the job's]
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(..=99_999_999))]
    pub program: Option<u32>,
    /// A value for a variable or prompt of the form
    #[arg(long, value_name = "VAR=VALUE")]
    pub set: Vec<String>,
    /// Where canned cycles come from
    #[arg(long, value_name = "WHERE", default_value = "form")]
    pub cycles: CyclesArg,
    /// How deep countersinks are
    #[arg(long, value_name = "FORMULA", default_value = "geometry")]
    pub csink_depth: SinkArg,
    /// Units of the program [default: those of the job]
    #[arg(long, value_name = "UNITS")]
    pub units: Option<UnitsArg>,
    /// Limits of the form [default: of postform.toml, else classic]
    #[arg(long, value_name = "LIMITS")]
    pub limits: Option<LimitsArg>,
}

/// `postform render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// The job: job.json, .jsonl, a CL file or an NC program, or - for standard input
    pub job: PathBuf,
    /// The form of the machine [default: that of postform.toml]
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// Where the program goes, or - for standard output; it appears there when it is complete
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// How it is rendered
    #[command(flatten)]
    pub options: RenderOptions,
    /// How the job is read
    #[command(flatten)]
    pub read: ReadArgs,
    /// Write the source map here: for each program line its form line and job item, as JSON Lines
    #[arg(long, value_name = "FILE")]
    pub trace: Option<PathBuf>,
    /// Print to standard output as it comes, even if an error cuts the program short
    #[arg(long)]
    pub stream: bool,
    /// Run the program, and print it only if it makes the job's motions
    #[arg(long, conflicts_with = "stream")]
    pub verify: bool,
    /// How `--verify` runs it
    #[command(flatten)]
    pub control: ControlArgs,
}

/// `postform verify`.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// The job, or - for standard input
    pub job: PathBuf,
    /// The form that prints the program; with --nc, what it says of the job's defaults
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// A program that is there already
    #[arg(long, value_name = "NC")]
    pub nc: Option<PathBuf>,
    /// How near places must be, in the job's units [default: 0.0001 inch, 0.002 mm]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub tolerance: Option<f64>,
    /// How the program is run
    #[command(flatten)]
    pub control: ControlArgs,
    /// How it is rendered
    #[command(flatten)]
    pub options: RenderOptions,
    /// How the job is read
    #[command(flatten)]
    pub read: ReadArgs,
}

/// How findings are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// With the lines they are about
    Pretty,
    /// One JSON document, version 1
    Json,
    /// Annotations of GitHub's workflows
    Github,
    /// A SARIF 2.1.0 log
    Sarif,
}

/// `postform lint`.
#[derive(Debug, Args)]
pub struct LintArgs {
    /// Forms, folders of forms, or - for standard input
    #[arg(required = true, value_name = "FORM")]
    pub forms: Vec<PathBuf>,
    /// Mend what can be mended without changing any program
    #[arg(long)]
    pub fix: bool,
    /// Show what the other fixes change in a program; with --fix, make them
    #[arg(long)]
    pub unsafe_fixes: bool,
    /// The job on which --unsafe-fixes shows it [default: a sample for the form's machine]
    #[arg(long, value_name = "JOB", requires = "unsafe_fixes")]
    pub job: Option<PathBuf>,
    /// How findings are shown
    #[arg(long, value_name = "FORMAT", default_value = "pretty")]
    pub format: Format,
    /// Limits of the form [default: of postform.toml, else classic]
    #[arg(long, value_name = "LIMITS")]
    pub limits: Option<LimitsArg>,
}

/// How a program is run.
#[derive(Clone, Debug, Args)]
pub struct ControlArgs {
    /// By whose rules [default: the form's Control, else fanuc]
    #[arg(long, value_name = "CONTROL")]
    pub control: Option<ControlArg>,
    /// Leave out blocks with a slash
    #[arg(long)]
    pub block_delete: bool,
    /// How far G73 backs off, and how near the last depth G83 goes back [default: as the control]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub back_off: Option<f64>,
    /// What a length without a point means on a Fanuc [default: it is an error]
    #[arg(long, value_name = "MEANING")]
    pub no_point: Option<NoPoint>,
}

fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length.is_finite() && length >= 0.0 => Ok(length),
        _ => Err("a length is a number from 0 on".into()),
    }
}

/// Controls whose reading is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ControlArg {
    /// LinuxCNC 2.9
    Linuxcnc,
    /// EMC as its old manual describes it
    Emc2,
    /// Fanuc and Haas mills
    Fanuc,
}

/// Lengths without a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum NoPoint {
    /// Whole inches or millimetres
    Whole,
    /// Least increments: 0.0001 inch, 0.001 mm
    Increments,
}

impl ControlArg {
    /// As the library has it.
    pub fn control(self) -> Control {
        match self {
            ControlArg::Linuxcnc => Control::Linuxcnc,
            ControlArg::Emc2 => Control::Emc2,
            ControlArg::Fanuc => Control::Fanuc,
        }
    }
}

impl NoPoint {
    /// As the library has it.
    pub fn unpointed(self) -> Unpointed {
        match self {
            NoPoint::Whole => Unpointed::Whole,
            NoPoint::Increments => Unpointed::Increments,
        }
    }
}

impl ControlArgs {
    /// As the library has it; `form` is the form's own control.
    pub fn settings(&self, form: Option<&str>, units: Units) -> Settings {
        let control = self.control.map_or_else(|| form.map_or(Control::Fanuc, Control::of_form), ControlArg::control);
        let unpointed = self.no_point.map_or(Unpointed::Refused, NoPoint::unpointed);
        Settings {
            units,
            block_delete: self.block_delete,
            back_off: self.back_off,
            unpointed,
            ..Settings::new(control)
        }
    }
}

/// How the motions of a program are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MotionFormat {
    /// A line an action
    Text,
    /// JSON Lines
    Json,
}

/// `postform simulate`.
#[derive(Debug, Args)]
pub struct SimulateArgs {
    /// The NC program, or - for standard input
    pub program: PathBuf,
    /// How it is run
    #[command(flatten)]
    pub control: ControlArgs,
    /// Units before the first G20 or G21
    #[arg(long, value_name = "UNITS", default_value = "mm")]
    pub units: UnitsArg,
    /// How motions are shown
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: MotionFormat,
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
    /// OLD and NEW program; with --form the JOB; with --forms OLD.pf, NEW.pf and the JOB
    #[arg(required = true, num_args = 1..=3, value_name = "FILE")]
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

/// `postform fmt`.
#[derive(Debug, Args)]
pub struct FmtArgs {
    /// Forms, folders of forms, or - to filter standard input
    #[arg(required = true, value_name = "FORM")]
    pub forms: Vec<PathBuf>,
    /// Write nothing, name the forms that are laid out otherwise
    #[arg(long)]
    pub check: bool,
}

/// `postform explain`.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// As PC003, cycle.depth.missing, Rapid, [vclear], Drill or deep
    #[arg(required_unless_present = "list")]
    pub what: Vec<String>,
    /// Name everything that can be asked for
    #[arg(long, conflicts_with = "what")]
    pub list: bool,
}

/// `postform new`.
#[derive(Debug, Args)]
pub struct NewArgs {
    /// For which control or machine
    #[arg(long, value_name = "NAME", ignore_case = true)]
    pub control: NewControl,
    /// Where the form goes, or - for standard output; a file that is there stays
    #[arg(short, long, value_name = "FORM", default_value = "-")]
    pub output: PathBuf,
}

/// What `postform new` has forms for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum NewControl {
    /// Fanuc 0i-M, vertical mill
    Fanuc,
    /// Haas VF
    Haas,
    /// Fadal, format 1
    Fadal,
    /// LinuxCNC, mill
    Linuxcnc,
    /// Grbl
    Grbl,
    /// Fanuc 0i-T, lathe
    Lathe,
    /// Wire EDM with four axes
    Edm,
}

/// `postform completions`.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Which shell
    pub shell: clap_complete::Shell,
}

/// `postform check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The job, or - for standard input
    #[arg(required_unless_present = "schema")]
    pub job: Option<PathBuf>,
    /// How the job is read
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print the JSON Schema of job files instead
    #[arg(long)]
    pub schema: bool,
}
