//! The setup sheet.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{ControlArgs, MachineArg, ReadArgs, RenderOptions};

/// How a sheet is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SheetFormat {
    /// A page that stands alone, for paper too
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
    /// The form of the machine [default: that of postform.toml]
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// Where the sheet goes: .html, .md or .json, or - for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// How it is written [default: by the output's extension, else html]
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<SheetFormat>,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// How the program is run to prove it
    #[command(flatten)]
    pub control: ControlArgs,
    /// How it is rendered
    #[command(flatten)]
    pub options: RenderOptions,
    /// How the job is read
    #[command(flatten)]
    pub read: ReadArgs,
}
