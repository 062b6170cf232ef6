//! The arguments of the command line.

mod controls;
mod editor;
mod forms;
mod jobs;
mod machines;
mod pictures;
mod posts;
mod programs;
mod restarts;
mod sheets;
mod tests;

use clap::{Args, Parser, Subcommand};

use super::colour::Colour;
pub use controls::{ControlArgs, ControlParser, NoPoint};
pub use editor::LspArgs;
pub use forms::{ExplainArgs, FmtArgs, Format, LimitsArg, LintArgs, NewArgs, PropertiesArgs, PropertiesFormat};
pub use jobs::{CheckArgs, ReadArgs, RenderArgs, RenderOptions, SplitArg, UnitsArg};
pub use machines::{FitArgs, MachineArg, MachineArgs, MachineCommand};
pub use pictures::{PlotArgs, WatchArgs};
pub use posts::NewPost;
pub use programs::{DiffArgs, DiffFormat, Layout, MotionFormat, SimulateArgs, StartArg, VerifyArgs, VerifyFormat};
pub use restarts::RestartArgs;
pub use sheets::{SheetArgs, SheetFormat};
pub use tests::{TestArgs, TestFormat};

/// Prints NC programs from toolpaths, by a form (a POSTFORM file) that describes the NC code of your machine.
#[derive(Debug, Parser)]
#[command(name = "postform", version, max_term_width = 100)]
pub struct Arguments {
    /// The command to run
    #[command(subcommand)]
    pub command: Command,
    /// When to use colour
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub color: Colour,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Print the NC program of a job
    Render(RenderArgs),
    /// Check forms, and report all findings
    Lint(LintArgs),
    /// Read a job, report its errors, and print a summary
    Check(CheckArgs),
    /// Prove that a program makes the motions of its job, by simulation
    Verify(VerifyArgs),
    /// Print the jobs of a folder, and compare the programs with the expected ones
    Test(TestArgs),
    /// Show the differences between two NC programs
    Diff(DiffArgs),
    /// Simulate an NC program, and print the actions of the machine
    Simulate(SimulateArgs),
    /// Check whether a program fits its machine, and print the allowed work offsets and tool lengths
    Fit(FitArgs),
    /// Write a program that begins in the middle of another program, with the modal state of that point
    Restart(RestartArgs),
    /// Write the setup sheet of a job: work offsets, tools, operations, stops, pictures
    Sheet(SheetArgs),
    /// Check a machine file
    Machine(MachineArgs),
    /// Draw the backplot of a job's program, or of an existing program
    Plot(PlotArgs),
    /// Show form, program and backplot in a browser, and update them after every change
    Watch(WatchArgs),
    /// Write forms in the canonical layout
    Fmt(FmtArgs),
    /// Explain a code, command, variable, sequence, cycle or control
    Explain(ExplainArgs),
    /// Write a commented form, control file or machine file to start from
    New(NewArgs),
    /// List the properties of a form: the settings for `--set`
    Properties(PropertiesArgs),
    /// List the controls, with the known facts of each
    Controls,
    /// Print the completions of a shell
    Completions(CompletionsArgs),
    /// Print the man page
    Man,
    /// Run the language server for editors, over standard input and output
    Lsp(LspArgs),
}

/// `postform completions`.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: clap_complete::Shell,
}
