//! Commands for jobs: render, check; and options for reading and rendering them.

use std::ffi::OsStr;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Args, Command, ValueEnum};

use postform::diag::{Diag, Severity};
use postform::internals::cl::{Assumed, AssumedSpeed, Dialect, parse_position};
use postform::internals::render::{Clock, Cycles};
use postform::toolpath::Units;
use postform::{Format, Options, Reading, Selection};

use postform::internals::control::Control;
use postform::internals::nc::Unpointed;

use super::super::clock;
use super::{ControlArgs, ControlParser, LimitsArg, MachineArg, NoPoint};

/// Reads the name of a format.
#[derive(Clone)]
pub struct FormatParser;

impl TypedValueParser for FormatParser {
    type Value = Format;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<Self::Value, clap::Error> {
        let names = PossibleValuesParser::new(Format::ALL.map(Format::name));
        names.try_map(|name| Format::parse(&name).ok_or("there is no such format")).parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(Format::ALL.into_iter().map(|format| PossibleValue::new(format.name()).help(format.about()))))
    }
}

/// Options for reading a job.
#[derive(Debug, Default, Args)]
pub struct ReadArgs {
    /// Format of the job [default: given by the file extension]
    #[arg(long, value_name = "FORMAT", value_parser = FormatParser)]
    pub from: Option<Format>,
    /// The job to read from a FreeCAD document with several, by its name or label
    #[arg(long = "job", value_name = "NAME")]
    pub job_name: Option<String>,
    /// CAM system that wrote a CL file: gener, catia, creo, nx, solidworks, makino, ncl, autodesk [default: given by its first lines]
    #[arg(long, value_name = "SYSTEM", value_parser = Dialect::parse)]
    pub dialect: Option<Dialect>,
    /// Units for a CL file, NCI file or program that contains none
    #[arg(long, value_name = "UNITS")]
    pub assume_units: Option<UnitsArg>,
    /// Tool number for a CL file or program without a tool change; if a CL file names several tools, write NAME=1,OTHER=2
    #[arg(long, value_name = "NUMBER", value_parser = Assumed::parse)]
    pub assume_tool: Option<Assumed>,
    /// Spindle speed, in revolutions per minute, of tools for which a CL file gives none; add ,CCLW for left-hand tools
    #[arg(long, value_name = "RPM", value_parser = AssumedSpeed::parse)]
    pub assume_speed: Option<AssumedSpeed>,
    /// Feed for a CL file that contains none, in units of the file per minute
    #[arg(long, value_name = "FEED", value_parser = positive)]
    pub assume_feed: Option<f64>,
    /// Start position of the tool, for a CL file or program that begins with a cut
    #[arg(long, visible_alias = "start", value_name = "X,Y,Z", value_parser = parse_position, allow_hyphen_values = true)]
    pub assume_start: Option<[f64; 3]>,
    /// Treat a CL file as complete even if it lacks the usual end statement of its CAM system
    #[arg(long)]
    pub assume_end: bool,
    /// Setup to read from a CL file with several tool directions; `check` lists the setups
    #[arg(long, value_name = "N", value_parser = setup)]
    pub setup: Option<usize>,
    /// The operations to read
    #[command(flatten)]
    pub select: SelectArgs,
    /// Control for which a job that is an NC program was written [default: fanuc]
    #[arg(long, value_name = "CONTROL", value_parser = ControlParser)]
    pub job_control: Option<&'static Control>,
    /// Meaning of a length without a decimal point in a job that is an NC program [default: it is an error]
    #[arg(long, value_name = "MEANING")]
    pub job_no_point: Option<NoPoint>,
}

/// The number of a setup.
fn setup(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|n| *n > 0);
    number.ok_or_else(|| "write the number of a setup, from 1; `postform check` lists the setups of a file".to_owned())
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
    number.ok_or_else(|| "write a number above zero".to_owned())
}

impl ReadArgs {
    /// The formats for which `--assume-units` is used.
    pub const UNITS: &[Format] = &[Format::Cl, Format::Nc, Format::Nci];
    /// The formats for which `--assume-tool` and `--assume-start` are used.
    pub const TOOL: &[Format] = &[Format::Cl, Format::Nc];

    /// Converts the options to the library's type. Options that do not apply to the format of the job are left out.
    pub fn reading(&self, format: Format) -> Reading {
        let mut reading = Reading::default();
        if ReadArgs::UNITS.contains(&format) {
            reading.units = self.assume_units.map(UnitsArg::units);
        }
        if ReadArgs::TOOL.contains(&format) {
            reading.tool = self.assume_tool.clone();
            reading.start = self.assume_start;
        }
        match format {
            Format::Cl => {
                reading.dialect = self.dialect;
                reading.speed = self.assume_speed;
                reading.feed = self.assume_feed;
                reading.end = self.assume_end;
                reading.setup = self.setup;
            }
            Format::Nc => {
                reading.control = self.job_control;
                reading.unpointed = self.job_no_point.map_or(Unpointed::Refused, NoPoint::unpointed);
            }
            Format::Freecad => reading.job = self.job_name.clone(),
            _ => {}
        }
        reading.select = self.select.selection();
        reading
    }

    /// Whether an option is given that only applies to a CL file.
    pub fn assumes_of_cl(&self) -> bool {
        self.assume_speed.is_some() || self.assume_feed.is_some() || self.assume_end || self.setup.is_some()
    }
}

/// The operations of a job to read.
#[derive(Clone, Debug, Default, Args)]
pub struct SelectArgs {
    /// Read only operations from the first one with this tool on
    #[arg(long, value_name = "TOOL")]
    pub from_tool: Option<u32>,
    /// Read only operations up to those with this tool
    #[arg(long, value_name = "TOOL")]
    pub until: Option<u32>,
    /// Read only operations with these tools, such as `3,5`
    #[arg(long, value_name = "TOOLS", value_delimiter = ',', value_parser = tool)]
    pub only: Vec<u32>,
    /// Skip operations with these tools
    #[arg(long, value_name = "TOOLS", value_delimiter = ',', value_parser = tool)]
    pub skip: Vec<u32>,
}

impl SelectArgs {
    /// Converts the options to the library's type.
    pub fn selection(&self) -> Selection {
        let SelectArgs { from_tool: from, until, only, skip } = self.clone();
        Selection { from, until, only, skip, ..Selection::default() }
    }
}

/// Reads `3` or `T3`.
pub(super) fn tool(text: &str) -> Result<u32, String> {
    text.strip_prefix(['T', 't']).unwrap_or(text).parse().map_err(|_| "write a tool as 3 or T3".into())
}

/// How canned cycles are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CyclesArg {
    /// By the sequences of the form
    Form,
    /// As single moves
    Emulated,
}

/// How the depth of a countersink is calculated from its diameter and angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SinkArg {
    /// Half the diameter, divided by the tangent of half the angle
    Geometry,
    /// Half the diameter, times the tangent of half the angle, as in GENER's manual: correct at 90 degrees only
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
    /// Converts the choice to the library's type.
    pub fn units(self) -> Units {
        match self {
            UnitsArg::Inch => Units::Inch,
            UnitsArg::Mm => Units::Mm,
        }
    }
}

/// Options for rendering a job with a form.
#[derive(Debug, Args)]
pub struct RenderOptions {
    /// The program's number [default: the job's]
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(..=99_999_999))]
    pub program: Option<u32>,
    /// The post to use from a form that contains several, by its Name
    #[arg(long, value_name = "NAME")]
    pub post: Option<String>,
    /// A value for a variable, prompt or property of the form
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Also prompt for the form's properties, if standard input is a terminal
    #[arg(long)]
    pub ask: bool,
    /// Date, or date and time, in the program [default: SOURCE_DATE_EPOCH, else now]
    #[arg(long, value_name = "DATE", value_parser = clock::parse)]
    pub date: Option<Clock>,
    /// How canned cycles are printed
    #[arg(long, value_name = "WHERE", default_value = "form")]
    pub cycles: CyclesArg,
    /// How the depth of a countersink is calculated from its diameter and angle
    #[arg(long, value_name = "FORMULA", default_value = "geometry")]
    pub csink_depth: SinkArg,
    /// Units of the program [default: those of the job]
    #[arg(long, value_name = "UNITS")]
    pub units: Option<UnitsArg>,
    /// Limits of the form [default: those in postform.toml, else classic]
    #[arg(long, value_name = "LIMITS")]
    pub limits: Option<LimitsArg>,
    /// Also print a program of over 100 MB that is over 1,000 times as long as its job
    #[arg(long)]
    pub huge: bool,
    /// Show errors only
    #[arg(short, long)]
    pub quiet: bool,
    /// Treat these findings as errors
    #[arg(long, value_name = "WHAT")]
    pub deny: Option<DenyArg>,
}

/// Findings that count as errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DenyArg {
    /// Warnings of the form, the job and the renderer
    Warnings,
}

impl RenderOptions {
    /// Converts the options to the library's type, without the values of variables.
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

    /// Whether a warning prevents printing.
    pub fn denies_warnings(&self) -> bool {
        self.deny == Some(DenyArg::Warnings)
    }

    /// Whether a finding is shown. With --quiet, only findings that prevent printing are shown.
    pub fn shows(&self, diag: &Diag) -> bool {
        diag.is_error() || !self.quiet || self.denies_warnings() && diag.severity == Severity::Warning
    }
}

/// `postform render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// The job: job.json, .jsonl, a CL file or an NC program, or - for standard input; with --out-dir or --join, several jobs or
    /// folders of jobs
    #[arg(required = true, value_name = "JOB")]
    pub jobs: Vec<PathBuf>,
    /// The form of the machine [default: that in postform.toml]
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// Output: a file, a folder (the form sets the file name), or - for standard output; written only when the program is complete
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// Print each job into this folder, which is created if it does not exist
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["output", "trace", "stream", "watch"])]
    pub out_dir: Option<PathBuf>,
    /// Make one program of all jobs, in the order of the command line
    #[arg(long, conflicts_with = "out_dir")]
    pub join: bool,
    /// Skip programs that are newer than their job, form, machine and postform.toml
    #[arg(long, requires = "out_dir")]
    pub changed: bool,
    /// Print a separate program for each of these parts of a job
    #[arg(long, value_name = "PART", requires = "out_dir")]
    pub split: Option<SplitArg>,
    /// Pattern for program names, with {job}, {part}, {tool}, {operation}, {work}, {setup}, {number} [default: the form's names;
    /// with --split: {job}-{part}]
    #[arg(long, value_name = "PATTERN", requires = "out_dir")]
    pub name: Option<String>,
    /// Number of programs that are printed at the same time [default: one per core]
    #[arg(long = "jobs", value_name = "N", requires = "out_dir")]
    pub at_a_time: Option<NonZeroUsize>,
    /// Options for rendering
    #[command(flatten)]
    pub options: RenderOptions,
    /// Options for reading the job
    #[command(flatten)]
    pub read: ReadArgs,
    /// Write the source map to this file: JSON Lines with the form line and the job item of each program line
    #[arg(long, value_name = "FILE")]
    pub trace: Option<PathBuf>,
    /// Print to standard output while rendering; the program is not verified, and an error may leave it incomplete
    #[arg(long, conflicts_with = "deny")]
    pub stream: bool,
    /// Print the program without verifying it
    #[arg(long)]
    pub no_verify: bool,
    /// Print the program only if it is proven; the verdict `not proven` is then an error
    #[arg(long, alias = "verify", conflicts_with_all = ["no_verify", "stream"])]
    pub require_proof: bool,
    /// Print again whenever the form or the job changes
    #[arg(long)]
    pub watch: bool,
    /// Options for simulating the program for the proof
    #[command(flatten)]
    pub control: ControlArgs,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
}

/// The parts into which a job is split.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SplitArg {
    /// A program for each tool
    Tool,
    /// A program for each operation
    Operation,
    /// A program for each work offset
    Work,
    /// A program for each setup, in a CL file with several tool directions
    Setup,
}

/// `postform check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The job, or - for standard input; or several jobs, or folders of jobs
    #[arg(required_unless_present = "schema", value_name = "JOB")]
    pub jobs: Vec<PathBuf>,
    /// Options for reading the job
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print the JSON Schema of job files instead
    #[arg(long)]
    pub schema: bool,
}
