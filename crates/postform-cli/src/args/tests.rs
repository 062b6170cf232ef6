//! `postform test`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// `postform test`.
#[derive(Debug, Args)]
pub struct TestArgs {
    /// Folders with cases, searched to their bottom, or jobs [default: tests, else the working folder]
    #[arg(value_name = "FOLDER")]
    pub paths: Vec<PathBuf>,
    /// The form, or a folder of forms; in place of those of [test] in postform.toml. May be given several times
    #[arg(long = "form", value_name = "FORM")]
    pub forms: Vec<PathBuf>,
    /// Write what the forms print now as what is expected, after the differences are shown
    #[arg(long)]
    pub update: bool,
    /// Write the standard cases for this form into the folder, with what it prints of each, to be looked through once
    #[arg(long, value_name = "FORM", conflicts_with_all = ["update", "forms", "coverage"])]
    pub new: Option<PathBuf>,
    /// List the lines of the forms that no case prints
    #[arg(long)]
    pub coverage: bool,
    /// How many programs are printed at a time [default: one a core]
    #[arg(long, value_name = "N")]
    pub jobs: Option<NonZeroUsize>,
    /// How the result is shown
    #[arg(long, value_enum, default_value_t = TestFormat::Pretty)]
    pub format: TestFormat,
}

/// How the result of the cases is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TestFormat {
    /// Differences, and a line with the counts
    Pretty,
    /// One JSON document
    Json,
    /// The XML that CI systems read
    Junit,
    /// Marks at the lines of expected programs, for a run on GitHub
    Github,
}
