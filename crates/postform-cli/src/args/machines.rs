//! Machine files, and programs that must fit into machines.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::{ControlArgs, UnitsArg, VerifyFormat};

/// `--machine`, for commands that check programs.
#[derive(Clone, Debug, Default, Args)]
pub struct MachineArg {
    /// Machine file: check that the program fits this machine [default: the form's MachineFile, else that in postform.toml]
    #[arg(long, value_name = "FILE")]
    pub machine: Option<PathBuf>,
}

/// `postform fit`.
#[derive(Debug, Args)]
pub struct FitArgs {
    /// The NC program, or - for standard input
    pub program: PathBuf,
    /// The machine file
    #[command(flatten)]
    pub machine: MachineArg,
    /// Options for simulating the program
    #[command(flatten)]
    pub control: ControlArgs,
    /// Units before the first G20 or G21
    #[arg(long, value_name = "UNITS", default_value = "mm")]
    pub units: UnitsArg,
    /// Output format of the result
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: VerifyFormat,
}

/// `postform machine`.
#[derive(Debug, Args)]
pub struct MachineArgs {
    /// The command
    #[command(subcommand)]
    pub command: MachineCommand,
}

/// Commands for machine files.
#[derive(Debug, Subcommand)]
pub enum MachineCommand {
    /// List the values in a machine file, and the checks that are left out because values are missing
    Check {
        /// The machine file
        file: PathBuf,
    },
}
