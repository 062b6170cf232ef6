//! What is done with jobs: read them, print their programs.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use postform::diag::{Diag, Severity};
use postform::internals::cl::{Assumed, AssumedSpeed, Dialect, parse_position};
use postform::internals::render::{Clock, Cycles};
use postform::toolpath::Units;
use postform::{Format, Options, Reading, Selection};

use postform::internals::control::Control;
use postform::internals::nc::Unpointed;

use super::super::clock;
use super::{ControlArgs, ControlParser, LimitsArg, MachineArg, NoPoint};

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
    /// A FreeCAD document
    Freecad,
    /// A Mastercam NCI file
    Nci,
}

/// How a job is read.
#[derive(Debug, Default, Args)]
pub struct ReadArgs {
    /// The job's format [default: by its extension]
    #[arg(long, value_name = "FORMAT")]
    pub from: Option<From>,
    /// Which job of a FreeCAD document that has several, by its name or label
    #[arg(long = "job", value_name = "NAME")]
    pub job_name: Option<String>,
    /// Who wrote a CL file: gener, catia, creo, nx, solidworks, makino, ncl, autodesk [default: by its first lines]
    #[arg(long, value_name = "SYSTEM", value_parser = Dialect::parse)]
    pub dialect: Option<Dialect>,
    /// Units of a CL file, NCI file or program that does not give them
    #[arg(long, value_name = "UNITS")]
    pub assume_units: Option<UnitsArg>,
    /// Tool number of a CL file or program that loads none; of a CL file that names several: NAME=1,OTHER=2
    #[arg(long, value_name = "NUMBER", value_parser = Assumed::parse)]
    pub assume_tool: Option<Assumed>,
    /// Spindle of tools for which a CL file says none: revolutions a minute, with ,CCLW for left-hand tools
    #[arg(long, value_name = "RPM", value_parser = AssumedSpeed::parse)]
    pub assume_speed: Option<AssumedSpeed>,
    /// Feed of a CL file that says none: units of the file a minute
    #[arg(long, value_name = "FEED", value_parser = positive)]
    pub assume_feed: Option<f64>,
    /// Where the tool is before a CL file or program that begins with a cut
    #[arg(long, visible_alias = "start", value_name = "X,Y,Z", value_parser = parse_position, allow_hyphen_values = true)]
    pub assume_start: Option<[f64; 3]>,
    /// A CL file is whole, though it does not end as its system ends files
    #[arg(long)]
    pub assume_end: bool,
    /// Which setup of a CL file whose tool points several ways: `check` lists them
    #[arg(long, value_name = "N", value_parser = setup)]
    pub setup: Option<usize>,
    /// Which operations are taken
    #[command(flatten)]
    pub select: SelectArgs,
    /// Whose rules a job that is an NC program follows [default: fanuc]
    #[arg(long, value_name = "CONTROL", value_parser = ControlParser)]
    pub job_control: Option<&'static Control>,
    /// What a length without a point means in a job that is an NC program [default: it is an error]
    #[arg(long, value_name = "MEANING")]
    pub job_no_point: Option<NoPoint>,
}

/// The number of a setup.
fn setup(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|n| *n > 0);
    number.ok_or_else(|| "write its number, from 1 on; `postform check` lists the setups of a file".to_owned())
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
    number.ok_or_else(|| "write a number above zero".to_owned())
}

impl From {
    /// The format as the library has it.
    pub fn format(self) -> Format {
        match self {
            From::Json => Format::Json,
            From::Jsonl => Format::JsonLines,
            From::Cl => Format::Cl,
            From::Nc => Format::Nc,
            From::Freecad => Format::Freecad,
            From::Nci => Format::Nci,
        }
    }
}

impl ReadArgs {
    /// The options of reading as the library has them.
    pub fn reading(&self) -> Reading {
        let mut reading = Reading::default();
        reading.dialect = self.dialect;
        reading.units = self.assume_units.map(UnitsArg::units);
        reading.tool = self.assume_tool.clone();
        reading.control = self.job_control;
        reading.job = self.job_name.clone();
        reading.unpointed = self.job_no_point.map_or(Unpointed::Refused, NoPoint::unpointed);
        reading.speed = self.assume_speed;
        reading.feed = self.assume_feed;
        reading.start = self.assume_start;
        reading.end = self.assume_end;
        reading.setup = self.setup;
        reading.select = self.select.selection();
        reading
    }

    /// Is something assumed that only a CL file can leave open?
    pub fn assumes_of_cl(&self) -> bool {
        self.assume_speed.is_some() || self.assume_feed.is_some() || self.assume_end || self.setup.is_some()
    }
}

/// Which operations of a job are taken.
#[derive(Clone, Debug, Default, Args)]
pub struct SelectArgs {
    /// Take the operations from the first with this tool on
    #[arg(long, value_name = "TOOL")]
    pub from_tool: Option<u32>,
    /// Take the operations up to those with this tool
    #[arg(long, value_name = "TOOL")]
    pub until: Option<u32>,
    /// Take the operations with these tools, as `3,5`
    #[arg(long, value_name = "TOOLS", value_delimiter = ',', value_parser = tool)]
    pub only: Vec<u32>,
    /// Leave out the operations with these tools
    #[arg(long, value_name = "TOOLS", value_delimiter = ',', value_parser = tool)]
    pub skip: Vec<u32>,
}

impl SelectArgs {
    fn selection(&self) -> Selection {
        let SelectArgs { from_tool: from, until, only, skip } = self.clone();
        Selection { from, until, only, skip, ..Selection::default() }
    }
}

/// `3` or `T3`.
pub(super) fn tool(text: &str) -> Result<u32, String> {
    text.strip_prefix(['T', 't']).unwrap_or(text).parse().map_err(|_| "a tool is written 3 or T3".into())
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
    /// The units as the library has them.
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
    /// Which post of a form that holds several, by its Name
    #[arg(long, value_name = "NAME")]
    pub post: Option<String>,
    /// A value for a variable, prompt or property of the form
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Ask for the form's properties too, where somebody can answer
    #[arg(long)]
    pub ask: bool,
    /// The day, or day and time, that the program says [default: SOURCE_DATE_EPOCH, else now]
    #[arg(long, value_name = "DATE", value_parser = clock::parse)]
    pub date: Option<Clock>,
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
    /// Print a program of over 100 MB also if it is over 1,000 times as long as its job
    #[arg(long)]
    pub huge: bool,
    /// Show errors only
    #[arg(short, long)]
    pub quiet: bool,
    /// What keeps a program from being printed, besides errors
    #[arg(long, value_name = "WHAT")]
    pub deny: Option<DenyArg>,
}

/// What counts as an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DenyArg {
    /// Warnings of the form, the job and the renderer
    Warnings,
}

impl RenderOptions {
    /// The options of rendering as the library has them, without the values of variables.
    pub fn options(&self) -> Options {
        let mut options = Options::default();
        options.program = self.program;
        options.units = self.units.map(UnitsArg::units);
        options.cycles = if self.cycles == CyclesArg::Emulated { Cycles::Emulated } else { Cycles::Form };
        options.sink_as_printed = self.csink_depth == SinkArg::Printed;
        options.huge = self.huge;
        options.clock = self.date.clone();
        options
    }

    /// Does a warning keep a program from being printed?
    pub fn denies_warnings(&self) -> bool {
        self.deny == Some(DenyArg::Warnings)
    }

    /// Which findings are shown: with --quiet those alone that keep a program from being printed.
    pub fn shows(&self, diag: &Diag) -> bool {
        diag.is_error() || !self.quiet || self.denies_warnings() && diag.severity == Severity::Warning
    }
}

/// `postform render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// The job: job.json, .jsonl, a CL file or an NC program, or - for standard input; with --out-dir several, or folders of jobs
    #[arg(required = true, value_name = "JOB")]
    pub jobs: Vec<PathBuf>,
    /// The form of the machine [default: that of postform.toml]
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// Where the program goes: a file, a folder in which the form names it, or - for standard output; it appears there when it is complete
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// Print each job into this folder, which is made if it is not there
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["output", "trace", "stream", "watch"])]
    pub out_dir: Option<PathBuf>,
    /// Leave out programs that are newer than their job, form, machine and postform.toml
    #[arg(long, requires = "out_dir")]
    pub changed: bool,
    /// Print a program of its own for each of these parts of a job
    #[arg(long, value_name = "PART", requires = "out_dir")]
    pub split: Option<SplitArg>,
    /// Names of the programs: {job}, {part}, {tool}, {operation}, {work}, {setup}, {number} [default: of the form; with --split {job}-{part}]
    #[arg(long, value_name = "PATTERN", requires = "out_dir")]
    pub name: Option<String>,
    /// How many programs are printed at a time [default: one a core]
    #[arg(long = "jobs", value_name = "N", requires = "out_dir")]
    pub at_a_time: Option<NonZeroUsize>,
    /// How it is rendered
    #[command(flatten)]
    pub options: RenderOptions,
    /// How the job is read
    #[command(flatten)]
    pub read: ReadArgs,
    /// Write the source map here: for each program line its form line and job item, as JSON Lines
    #[arg(long, value_name = "FILE")]
    pub trace: Option<PathBuf>,
    /// Print to standard output as it comes, not verified, even if an error cuts the program short
    #[arg(long, conflicts_with = "deny")]
    pub stream: bool,
    /// Print the program without running it to see whether it does what the job asks for
    #[arg(long)]
    pub no_verify: bool,
    /// Print the program only if it is proven: `not proven` is not enough
    #[arg(long, alias = "verify", conflicts_with_all = ["no_verify", "stream"])]
    pub require_proof: bool,
    /// Print again whenever the form or the job is changed
    #[arg(long)]
    pub watch: bool,
    /// How the program is run to prove it
    #[command(flatten)]
    pub control: ControlArgs,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
}

/// What a job is split by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SplitArg {
    /// A program for each tool
    Tool,
    /// A program for each operation
    Operation,
    /// A program for each work offset
    Work,
    /// A program for each setup of a CL file whose tool points several ways
    Setup,
}

/// `postform check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The job, or - for standard input; or several jobs, or folders of jobs
    #[arg(required_unless_present = "schema", value_name = "JOB")]
    pub jobs: Vec<PathBuf>,
    /// How the job is read
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print the JSON Schema of job files instead
    #[arg(long)]
    pub schema: bool,
}
