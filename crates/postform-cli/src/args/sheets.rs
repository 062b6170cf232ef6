//! The setup sheet.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{ControlArgs, MachineArg, ReadArgs, RenderOptions};

/// The output format of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SheetFormat {
    /// A self-contained page, also for printing
    Html,
    /// Markdown, without pictures
    Md,
    /// One JSON document
    Json,
}

/// `postform sheet`.
#[derive(Debug, Args)]
pub struct SheetArgs {
    /// The job, or an NC program
    pub job: PathBuf,
    /// The form of the machine [default: that in postform.toml]
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// Output file of the sheet: .html, .md or .json, or - for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// Output format [default: by the output's extension, else html]
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<SheetFormat>,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// Options for running the program to prove it
    #[command(flatten)]
    pub control: ControlArgs,
    /// Options for rendering
    #[command(flatten)]
    pub options: RenderOptions,
    /// Options for reading the job
    #[command(flatten)]
    pub read: ReadArgs,
}
