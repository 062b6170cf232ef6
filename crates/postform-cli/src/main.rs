//! The command line of postform: arguments, files, the terminal. The library makes all decisions.
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod args;
mod beside;
mod callers;
mod check;
mod clock;
mod colour;
mod config;
mod destination;
mod diff;
mod each;
mod explain;
mod files;
mod fmt;
mod folders;
mod forms;
mod identity;
mod inputs;
mod job_format;
mod lint;
mod lsp;
mod machine;
mod many;
mod new;
mod output;
mod packed;
mod plot;
mod poll;
mod prepare;
mod progress;
mod prompt;
mod properties;
mod render;
mod rendered;
mod report;
mod restart;
mod say;
mod sheet;
mod shells;
mod simulate;
mod spool;
mod stock;
mod test;
mod unnamed;
mod verdict;
mod verify;
mod watch;

use std::process::ExitCode;

use clap::{CommandFactory as _, Parser as _};
use postform::internals::terminal::steers;

use postform::diag::{Code, Diag};

use args::{Arguments, Command};

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Success without findings.
    Clean,
    /// Findings, differences, or an error in a job or form.
    Findings,
    /// Wrong usage, or a file that can't be read or written.
    Failed,
    /// A fault of postform itself.
    Broken,
}

impl Ending {
    /// The end of a command after an error.
    pub fn of(error: &Diag) -> Ending {
        if error.code == Code::PX001 { Ending::Broken } else { Ending::Findings }
    }
}

impl From<Ending> for ExitCode {
    fn from(ending: Ending) -> ExitCode {
        ExitCode::from(match ending {
            Ending::Clean => 0,
            Ending::Findings => 1,
            Ending::Failed => 2,
            Ending::Broken => 101,
        })
    }
}

/// Shows an error in the arguments. If the arguments contain control characters, the characters are escaped and the
/// error is shown without colour.
fn refused(error: &clap::Error) {
    if !std::env::args_os().any(|arg| arg.to_string_lossy().chars().any(steers)) {
        _ = error.print(); // an error of the terminal does not matter here
        return;
    }
    let plain = Arguments::command().styles(clap::builder::Styles::plain());
    if let Err(error) = plain.try_get_matches_from(std::env::args_os()) {
        say::message(error.render().ansi().to_string().trim_end());
    }
}

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            return match error.use_stderr() {
                true => {
                    refused(&error);
                    Ending::Failed.into()
                }
                // the text of --help or --version
                false => ended(output::shown(|_| error.print())),
            };
        }
    };
    let colour = arguments.color.on_stderr();
    let ending = match arguments.command {
        Command::Render(args) => render::run(&args, colour),
        Command::Lint(args) => lint::run(&args, arguments.color),
        Command::Check(args) => check::run(&args, colour),
        Command::Verify(args) => verify::run(&args, colour),
        Command::Test(args) => test::run(&args, arguments.color),
        Command::Diff(args) => diff::run(&args, arguments.color),
        Command::Simulate(args) => simulate::run(&args, colour),
        Command::Fit(args) => machine::fit(&args, colour),
        Command::Restart(args) => restart::run(&args),
        Command::Sheet(args) => sheet::run(&args, colour),
        Command::Machine(args) => machine::run(&args),
        Command::Plot(args) => plot::run(&args, colour),
        Command::Watch(args) => watch::run(args),
        Command::Fmt(args) => fmt::run(&args),
        Command::Explain(args) => explain::run(&args),
        Command::Controls => output::shown(|out| {
            std::io::Write::write_all(out, postform::internals::explain::controls::list().as_bytes())
        }),
        Command::New(args) => new::run(&args),
        Command::Properties(args) => properties::run(&args, colour),
        Command::Completions(args) => shells::completions(&args),
        Command::Man => shells::man(),
        Command::Lsp(args) => lsp::run(&args),
    };
    ended(ending)
}

/// The exit status of a command. Shows the message of a failed command.
fn ended(ending: Result<Ending, String>) -> ExitCode {
    let ending = ending.unwrap_or_else(|text| {
        say::message(&text);
        Ending::Failed
    });
    ending.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_of_postform_has_an_exit_status_of_its_own() {
        assert_eq!(Ending::of(&Diag::new(Code::PX001, "")), Ending::Broken);
        assert_eq!(Ending::of(&Diag::new(Code::PC002, "")), Ending::Findings);
    }
}
