//! `postform test`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// `postform test`.
#[derive(Debug, Args)]
pub struct TestArgs {
    /// Folders with cases, including their subfolders, or single jobs [default: tests, else the working folder]
    #[arg(value_name = "FOLDER")]
    pub paths: Vec<PathBuf>,
    /// A form, or a folder of forms, instead of those under [test] in postform.toml; may be given several times
    #[arg(long = "form", value_name = "FORM")]
    pub forms: Vec<PathBuf>,
    /// The post to use from a form that contains several, by its Name [default: the post under [test] in postform.toml]
    #[arg(long, value_name = "NAME")]
    pub post: Option<String>,
    /// Show the differences, then write the printed programs as the expected ones
    #[arg(long)]
    pub update: bool,
    /// Write the standard cases for this form, and the programs that the form prints, into FOLDER; check these programs once by hand
    #[arg(long, value_name = "FORM", conflicts_with_all = ["update", "forms", "coverage"])]
    pub new: Option<PathBuf>,
    /// List the lines of the forms that no case prints
    #[arg(long)]
    pub coverage: bool,
    /// Number of programs that are printed at the same time [default: one per core]
    #[arg(long, value_name = "N")]
    pub jobs: Option<NonZeroUsize>,
    /// Output format of the result
    #[arg(long, value_enum, default_value_t = TestFormat::Pretty)]
    pub format: TestFormat,
}

/// The output format of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TestFormat {
    /// Differences, and a line with the counts
    Pretty,
    /// One JSON document
    Json,
    /// JUnit XML, for CI systems
    Junit,
    /// Annotations at the lines of expected programs, for a run on GitHub
    Github,
}
