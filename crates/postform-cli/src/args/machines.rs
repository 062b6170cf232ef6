//! Machines: their files, and programs that must fit into them.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::{ControlArgs, UnitsArg, VerifyFormat};

/// `--machine`, of commands that look at programs.
#[derive(Clone, Debug, Args)]
pub struct MachineArg {
    /// The file of the machine into which the program must fit [default: the form's MachineFile, else that of postform.toml]
    #[arg(long, value_name = "FILE")]
    pub machine: Option<PathBuf>,
}

/// `postform fit`.
#[derive(Debug, Args)]
pub struct FitArgs {
    /// The NC program, or - for standard input
    pub program: PathBuf,
    /// The machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// How it is run
    #[command(flatten)]
    pub control: ControlArgs,
    /// Units before the first G20 or G21
    #[arg(long, value_name = "UNITS", default_value = "mm")]
    pub units: UnitsArg,
    /// How the answer is shown
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub format: VerifyFormat,
}

/// `postform machine`.
#[derive(Debug, Args)]
pub struct MachineArgs {
    /// What to do with it
    #[command(subcommand)]
    pub command: MachineCommand,
}

/// What is done with the file of a machine.
#[derive(Debug, Subcommand)]
pub enum MachineCommand {
    /// List the values in the file, and what is not checked for want of one
    Check {
        /// The file
        file: PathBuf,
    },
}
