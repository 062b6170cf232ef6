//! `postform completions` and `postform man`, from the same definitions as `--help`.

use std::io::Write as _;

use clap::CommandFactory;

use super::args::{Arguments, CompletionsArgs};
use super::{Ending, output};

/// Prints the completions of a shell.
pub fn completions(args: &CompletionsArgs) -> Result<Ending, String> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Arguments::command(), "postform", &mut text);
    output::shown(|out| out.write_all(&text))
}

/// Prints the man page: postform itself, then each command.
pub fn man() -> Result<Ending, String> {
    output::shown(|out| {
        let mut command = Arguments::command();
        command.build(); // full names of the commands
        clap_mangen::Man::new(command.clone()).render(out)?;
        for sub in command.get_subcommands().filter(|sub| sub.get_name() != "help") {
            writeln!(out, ".SH \"postform {}\"", sub.get_name())?;
            let page = clap_mangen::Man::new(sub.clone());
            page.render_synopsis_section(out)?;
            page.render_description_section(out)?;
            page.render_options_section(out)?;
        }
        Ok(())
    })
}
