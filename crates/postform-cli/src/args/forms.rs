//! Commands for forms: lint, fmt, explain, properties, new.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use postform::internals::control::Control;

use super::{ControlParser, NewPost};

use postform::internals::sema::Limits;

/// Classic or extended limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LimitsArg {
    #[default]
    /// 15 words per line, 150 lines per form
    Classic,
    /// The same limits, but as warnings
    Extended,
}

impl LimitsArg {
    /// Converts the choice to the library's type.
    pub fn limits(self) -> Limits {
        match self {
            LimitsArg::Classic => Limits::Classic,
            LimitsArg::Extended => Limits::Extended,
        }
    }
}

/// The output format of findings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// With the lines of the form
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
    /// Apply all fixes that change no program
    #[arg(long)]
    pub fix: bool,
    /// Show the effect of the other fixes on a program; with --fix, apply them
    #[arg(long)]
    pub unsafe_fixes: bool,
    /// The job for --unsafe-fixes [default: a sample for the form's machine]
    #[arg(long, value_name = "JOB", requires = "unsafe_fixes")]
    pub job: Option<PathBuf>,
    /// Output format of the findings
    #[arg(long, value_name = "FORMAT", default_value = "pretty")]
    pub format: Format,
    /// Limits of the form [default: those in postform.toml, else classic]
    #[arg(long, value_name = "LIMITS")]
    pub limits: Option<LimitsArg>,
    /// The post to use from a form that contains several, by its Name
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
    /// Write nothing; print the names of forms that would change
    #[arg(long)]
    pub check: bool,
    /// Also format files without the extension of a form, and files with lines that make no sense
    #[arg(long)]
    pub force: bool,
}

/// `postform explain`.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// A name, such as PC003, cycle.depth.missing, Rapid, [vclear], Drill or deep
    #[arg(required_unless_present = "list")]
    pub what: Vec<String>,
    /// List all names that can be explained
    #[arg(long, conflicts_with = "what")]
    pub list: bool,
}

/// `postform properties`.
#[derive(Debug, Args)]
pub struct PropertiesArgs {
    /// The form, or - for standard input
    pub form: PathBuf,
    /// The post to use from a form that contains several, by its Name
    #[arg(long, value_name = "NAME")]
    pub post: Option<String>,
    /// Output format of the properties
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: PropertiesFormat,
}

/// The output format of properties.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PropertiesFormat {
    /// Text
    Text,
    /// One JSON document, version 1
    Json,
}

/// `postform new`.
#[derive(Debug, Args)]
pub struct NewArgs {
    /// The control or machine of the new form
    #[arg(long, value_name = "NAME", ignore_case = true, required_unless_present_any = ["control_file", "machine"])]
    pub control: Option<NewPost>,
    /// Write a file that describes a control like this one, instead of a form
    #[arg(long, value_name = "NAME", value_parser = ControlParser, conflicts_with = "control")]
    pub control_file: Option<&'static Control>,
    /// Write a commented machine file for this control, instead of a form
    #[arg(long, value_name = "CONTROL", value_parser = ControlParser, conflicts_with_all = ["control", "control_file"])]
    pub machine: Option<&'static Control>,
    /// Output file, or - for standard output; an existing file is not replaced
    #[arg(short, long, value_name = "FORM", default_value = "-")]
    pub output: PathBuf,
}
