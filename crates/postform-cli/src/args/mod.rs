//! What can be typed.

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
pub use jobs::{CheckArgs, From, ReadArgs, RenderArgs, RenderOptions, SplitArg, UnitsArg};
pub use machines::{FitArgs, MachineArg, MachineArgs, MachineCommand};
pub use pictures::{PlotArgs, WatchArgs};
pub use posts::NewPost;
pub use programs::{DiffArgs, DiffFormat, Layout, MotionFormat, SimulateArgs, StartArg, VerifyArgs, VerifyFormat};
pub use restarts::RestartArgs;
pub use sheets::{SheetArgs, SheetFormat};
pub use tests::{TestArgs, TestFormat};

/// The compiler for POSTFORM files: NC programs from toolpaths, by a template of your machine's code.
#[derive(Debug, Parser)]
#[command(name = "postform", version, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
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
    /// Report every finding of every form
    Lint(LintArgs),
    /// Read a job, report what is wrong, and print what is in it
    Check(CheckArgs),
    /// Prove that a program makes the motions of its job
    Verify(VerifyArgs),
    /// Print the jobs of a folder, and compare the programs with those that are expected
    Test(TestArgs),
    /// Show what changed between two NC programs
    Diff(DiffArgs),
    /// Run an NC program and print what the machine does
    Simulate(SimulateArgs),
    /// Say whether a program fits into a machine, and which offsets and lengths would do
    Fit(FitArgs),
    /// Write a program that begins in the middle of another one, with everything in force that is in force there
    Restart(RestartArgs),
    /// Write the setup sheet of a job: offsets, tools, operations, stops, pictures
    Sheet(SheetArgs),
    /// Look at the file of a machine
    Machine(MachineArgs),
    /// Draw the backplot of a job's program, or of a program that is there
    Plot(PlotArgs),
    /// Show form, program and backplot in a browser, again with every change
    Watch(WatchArgs),
    /// Write forms in the canonical layout
    Fmt(FmtArgs),
    /// Say what a code, command, variable, sequence, cycle or control means
    Explain(ExplainArgs),
    /// Write a commented form, or a control's file, to start from
    New(NewArgs),
    /// List what a form leaves to the shop, by names that `--set` takes
    Properties(PropertiesArgs),
    /// List the controls, with what is known of each
    Controls,
    /// Print the completions of a shell
    Completions(CompletionsArgs),
    /// Print the man page
    Man,
    /// Serve an editor: findings, completion, hover and more, over standard input and output
    Lsp(LspArgs),
}

/// `postform completions`.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Which shell
    pub shell: clap_complete::Shell,
}
