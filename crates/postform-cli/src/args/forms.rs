//! What is done with forms: look at them, lay them out, explain them, begin one.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use postform::internals::control::Control;

use super::{ControlParser, NewPost};

use postform::internals::sema::Limits;

/// Classic or extended limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LimitsArg {
    #[default]
    /// 15 words a line, 150 lines a form
    Classic,
    /// The same as warnings
    Extended,
}

impl LimitsArg {
    /// The limits as the library has them.
    pub fn limits(self) -> Limits {
        match self {
            LimitsArg::Classic => Limits::Classic,
            LimitsArg::Extended => Limits::Extended,
        }
    }
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
    /// Fix what can be fixed without changing any program
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
    /// Which post of a form that holds several, by its Name
    #[arg(long, value_name = "NAME", conflicts_with = "fix")]
    pub post: Option<String>,
    /// Report again whenever a form is changed
    #[arg(long, conflicts_with_all = ["fix", "unsafe_fixes"])]
    pub watch: bool,
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
    /// Lay out files that are no forms by their names, and files with lines that make no sense
    #[arg(long)]
    pub force: bool,
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

/// `postform properties`.
#[derive(Debug, Args)]
pub struct PropertiesArgs {
    /// The form, or - for standard input
    pub form: PathBuf,
    /// Which post of a form that holds several, by its Name
    #[arg(long, value_name = "NAME")]
    pub post: Option<String>,
    /// How they are shown
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: PropertiesFormat,
}

/// How properties are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PropertiesFormat {
    /// For people
    Text,
    /// One JSON document, version 1
    Json,
}

/// `postform new`.
#[derive(Debug, Args)]
pub struct NewArgs {
    /// For which control or machine
    #[arg(long, value_name = "NAME", ignore_case = true, required_unless_present_any = ["control_file", "machine"])]
    pub control: Option<NewPost>,
    /// A file that describes a control like this one, instead of a form
    #[arg(long, value_name = "NAME", value_parser = ControlParser, conflicts_with = "control")]
    pub control_file: Option<&'static Control>,
    /// The commented file of a machine with this control, instead of a form
    #[arg(long, value_name = "CONTROL", value_parser = ControlParser, conflicts_with_all = ["control", "control_file"])]
    pub machine: Option<&'static Control>,
    /// Where the form goes, or - for standard output; a file that is there stays
    #[arg(short, long, value_name = "FORM", default_value = "-")]
    pub output: PathBuf,
}
