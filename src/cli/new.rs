//! `postform new`.

use std::io::Write as _;

use super::args::{NewArgs, NewControl};
use super::files::name;
use super::{Ending, output};

/// The form to start from: one that ships, lint-clean and rendered in tests.
fn form(control: NewControl) -> &'static str {
    match control {
        NewControl::Fanuc => include_str!("../../postforms/fanuc.pf"),
        NewControl::Haas => include_str!("../../postforms/haas.pf"),
        NewControl::Fadal => include_str!("../../postforms/fadal.pf"),
        NewControl::Linuxcnc => include_str!("../../postforms/linuxcnc.pf"),
        NewControl::Grbl => include_str!("../../postforms/grbl.pf"),
        NewControl::Lathe => include_str!("../../postforms/fanuc-lathe.pf"),
        NewControl::Edm => include_str!("../../postforms/wire-edm.pf"),
    }
}

/// Writes the form; a file that is there is somebody's work and stays.
pub fn run(args: &NewArgs) -> Result<Ending, String> {
    let text = form(args.control);
    if args.output.as_os_str() == "-" {
        return output::shown(|out| out.write_all(text.as_bytes()));
    }
    // a link that leads nowhere is there, too
    if args.output.symlink_metadata().is_ok() {
        let name = name(&args.output);
        return Err(format!("error: {name} is there already\n  help: take another name, or remove it first"));
    }
    output::write_whole(&args.output, text.as_bytes())?;
    eprintln!("{} is written: change it, then `postform lint {0}`", name(&args.output));
    Ok(Ending::Clean)
}
