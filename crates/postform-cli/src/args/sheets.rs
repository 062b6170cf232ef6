//! The setup sheet.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{ControlArgs, MachineArg, ReadArgs, RenderOptions};

/// The output format of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SheetFormat {
    /// A web page that needs no other files and can be printed
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
    /// Output format [default: given by the extension of the output, else html]
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<SheetFormat>,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// Options for simulating the program for the proof
    #[command(flatten)]
    pub control: ControlArgs,
    /// Options for rendering
    #[command(flatten)]
    pub options: RenderOptions,
    /// Options for reading the job
    #[command(flatten)]
    pub read: ReadArgs,
}
