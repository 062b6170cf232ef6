//! `postform restart`.

use postform::internals::nc::settings_for;
use postform::internals::restart::{Asked, Refused, Target, restart};
use postform::internals::terminal::escaped_lines;

use super::Ending;
use super::args::{ControlArgs, RestartArgs};
use super::config::Config;
use super::files::{self, io_message};
use super::output::Target as Output;
use super::report::count;
use super::say::message;

/// Writes a program that begins in the middle of another program.
pub fn run(args: &RestartArgs) -> Result<Ending, String> {
    let config = Config::near(&args.program)?;
    let control = ControlArgs { control: args.control.control.or(config.control), ..args.control.clone() };
    let mut program = files::open_program(&args.program)?;
    let settings = settings_for(&mut program, &args.program, control.settings(None, args.units.units()))
        .map_err(|error| io_message("read", &args.program, &error))?;
    let target = match (args.tool, args.at, args.line, &args.operation) {
        (Some(tool), ..) => Target::Tool(tool),
        (_, Some(number), ..) => Target::Block(number),
        (_, _, Some(line), _) => Target::Line(line),
        (.., Some(name)) => Target::Operation(name.clone()),
        _ => return Err("error: no entry point is given: use --tool, --at, --line or --operation".into()),
    };
    let mut output = Output::open(&args.output, false)?;
    let asked = Asked { target, clear: args.clear_z, exactly: args.exactly };
    let made = match restart(program, settings, &asked) {
        Ok(made) => made,
        Err(Refused::Io(error)) => return Err(io_message("read", &args.program, &error)),
        Err(Refused::Why(why, help)) => {
            let help = if help.is_empty() { String::new() } else { format!("\n  help: {help}") };
            message(&escaped_lines(&format!("error: {why}{help}")));
            return Ok(Ending::Findings);
        }
    };
    let name = files::name(&args.program);
    message(&format!(
        "the new program begins at line {} of {name}; proven: from there it makes the same {} with the same tool, \
         offsets, spindle and coolant",
        made.line,
        count(made.moves as usize, "step")
    ));
    for note in &made.notes {
        message(&escaped_lines(note));
    }
    message("before you run it, check its first blocks, the clamping, the tool in the spindle and the coolant");
    output
        .write(&made.text)
        .and_then(|()| output.complete())
        .map_err(|error| io_message("write", &args.output, &error))?;
    Ok(Ending::Clean)
}
