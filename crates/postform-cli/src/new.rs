//! `postform new`.

use std::io::{self, Write as _};

use postform::internals::explain::controls;

use super::args::NewArgs;
use super::files::{io_message, name};
use super::say::message;
use super::{Ending, output};

/// Writes the form; an existing file is never replaced.
pub fn run(args: &NewArgs) -> Result<Ending, String> {
    let text = match (args.machine, args.control_file, args.control) {
        (Some(control), ..) => postform::internals::machine::template(control),
        (None, Some(control), _) => controls::file(control),
        (None, None, Some(post)) => post.0.text.to_owned(),
        (None, None, None) => {
            return Err("error: give --control for a form, or --control-file for a control".into());
        }
    };
    if args.output.as_os_str() == "-" {
        return output::shown(|out| out.write_all(text.as_bytes()));
    }
    // this call creates a new file: it never replaces an existing file or a link without a target
    output::write_new(&args.output, text.as_bytes()).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => {
            format!(
                "error: {} exists already\n  help: choose another name, or remove the file first",
                name(&args.output)
            )
        }
        _ => io_message("write", &args.output, &error),
    })?;
    let written = name(&args.output);
    message(&match args.control_file {
        _ if args.machine.is_some() => {
            format!("{written} is written: change it, then `postform machine check {written}`")
        }
        Some(_) => {
            format!("{written} is written: change it, then write `Control {written}` in the form in the same folder")
        }
        None => format!("{written} is written: change it, then `postform lint {written}`"),
    });
    Ok(Ending::Clean)
}
