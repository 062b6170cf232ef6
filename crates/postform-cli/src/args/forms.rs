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
    /// The same limits; a form that exceeds them gets a warning, not an error
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
    /// Text, with the lines of the form
    Pretty,
    /// One JSON document, version 1
    Json,
    /// Annotations for GitHub workflows
    Github,
    /// A SARIF 2.1.0 log
    Sarif,
}

/// `postform lint`.
#[derive(Debug, Args)]
pub struct LintArgs {
    /// Forms, folders of forms, or - for standard input
    #[arg(required_unless_present = "job", value_name = "FORM")]
    pub forms: Vec<PathBuf>,
    /// Apply all fixes that do not change the program
    #[arg(long)]
    pub fix: bool,
    /// Show how the other fixes change the program of the job; with --fix, apply them too
    #[arg(long)]
    pub unsafe_fixes: bool,
    /// The job for which --unsafe-fixes shows the change of the program [default: a sample job for the form's machine]
    #[arg(long, value_name = "JOB")]
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
    /// Repeat the report whenever a form is changed
    #[arg(long, conflicts_with_all = ["fix", "unsafe_fixes"])]
    pub watch: bool,
}

/// `postform fmt`.
#[derive(Debug, Args)]
pub struct FmtArgs {
    /// Forms, folders of forms, or - to format standard input and print the result
    #[arg(required = true, value_name = "FORM")]
    pub forms: Vec<PathBuf>,
    /// Write nothing; print the names of forms that would change
    #[arg(long)]
    pub check: bool,
    /// Also format files that are not named as forms, and files with invalid lines
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
    /// Write a template of a control file, based on this control, instead of a form
    #[arg(long, value_name = "NAME", value_parser = ControlParser, conflicts_with = "control")]
    pub control_file: Option<&'static Control>,
    /// Write a commented machine file for this control, instead of a form
    #[arg(long, value_name = "CONTROL", value_parser = ControlParser, conflicts_with_all = ["control", "control_file"])]
    pub machine: Option<&'static Control>,
    /// Output file, or - for standard output; an existing file is not replaced
    #[arg(short, long, value_name = "FORM", default_value = "-")]
    pub output: PathBuf,
}
