//! `postform new`.

use std::io::{self, Write as _};

use postform::internals::explain::controls;
use postform::internals::post::shipped;

use super::args::{NewArgs, NewControl};
use super::files::{io_message, name};
use super::say::message;
use super::{Ending, output};

/// The form to start from: one that ships, lint-clean and rendered in tests.
fn form(control: NewControl) -> &'static str {
    match control {
        NewControl::Fanuc => shipped::FANUC,
        NewControl::Haas => shipped::HAAS,
        NewControl::Haas4Axis => shipped::HAAS_4AXIS,
        NewControl::Fadal => shipped::FADAL,
        NewControl::FadalSubs => shipped::FADAL_SUBS,
        NewControl::Linuxcnc => shipped::LINUXCNC,
        NewControl::Grbl => shipped::GRBL,
        NewControl::Siemens => shipped::SIEMENS,
        NewControl::Heidenhain => shipped::HEIDENHAIN,
        NewControl::Okuma => shipped::OKUMA,
        NewControl::FanucLathe => shipped::FANUC_LATHE,
        NewControl::HaasLathe => shipped::HAAS_LATHE,
        NewControl::WireEdm => shipped::WIRE_EDM,
    }
}

/// Writes the form; a file that is there is somebody's work and stays.
pub fn run(args: &NewArgs) -> Result<Ending, String> {
    let text = match (args.control_file, args.control) {
        (Some(control), _) => controls::file(control),
        (None, Some(control)) => form(control).to_owned(),
        (None, None) => return Err("error: say which form by --control, or which control by --control-file".into()),
    };
    if args.output.as_os_str() == "-" {
        return output::shown(|out| out.write_all(text.as_bytes()));
    }
    // exclusive: what is there stays, a link that leads nowhere too
    output::write_new(&args.output, text.as_bytes()).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => {
            format!("error: {} is there already\n  help: take another name, or remove it first", name(&args.output))
        }
        _ => io_message("write", &args.output, &error),
    })?;
    let written = name(&args.output);
    message(&match args.control_file {
        Some(_) => format!("{written} is written: change it, then write `Control {written}` in the form beside it"),
        None => format!("{written} is written: change it, then `postform lint {written}`"),
    });
    Ok(Ending::Clean)
}
