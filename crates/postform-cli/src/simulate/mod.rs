//! `postform simulate`.

mod summary;
mod text;

use std::io::{self, Write};
use std::path::Path;

use postform::diag::Diag;
use postform::internals::control::Kept;
use postform::internals::nc::{Action, RunError, RunSettings, Simulator, Tally, json_line, settings_for};
use postform::internals::preflight::Known;
use postform::toolpath::Units;

use super::Ending;
use super::args::{ControlArgs, MotionFormat, SimulateArgs, StartArg, UnitsArg};
use super::files::{self, io_message};
use super::machine::{self, Fitting};
use super::report::{Reporter, place_in};
use super::say::{message, say};

/// Size of the text buffer before it is written.
const CHUNK: usize = 64 * 1024;
/// Maximum number of warnings that are shown. Further warnings are only counted.
const MOST_WARNINGS: usize = 20;
/// The run stops after this number of refused blocks.
const MOST_REFUSED: usize = 20;

/// Runs a program and prints the actions of the machine.
pub fn run(args: &SimulateArgs, colour: bool) -> Result<Ending, String> {
    let config = super::config::Config::near(&args.program)?;
    let machine = machine::named(&args.machine, None, &config)?;
    let of_machine = machine.as_ref().and_then(|machine| machine.control);
    let named = args.control.control.or(of_machine).or(config.control);
    let control = ControlArgs { control: named, ..args.control.clone() };
    let unknown = args.start == StartArg::Unknown;
    let settings = RunSettings {
        places_unknown: unknown,
        ..control.settings(None, args.units.map_or(Units::Mm, UnitsArg::units))
    };
    let mut program = files::open_program(&args.program)?;
    let settings = settings_for(&mut program, &args.program, settings)
        .map_err(|error| io_message("read", &args.program, &error))?;
    let on_machine = program.try_clone().map_err(|error| io_message("read", &args.program, &error))?;
    let mut simulator = Simulator::new(program, settings);
    let shown = text::Shown::of(&settings);
    let mut tally = Tally::new(settings.units);
    let mut units_known = args.units.is_some() || settings.control.traits().modes_at_start != Kept::Yes;
    let mut warnings = Vec::new();
    let mut left_out = 0;
    let mut items = Vec::new();
    let mut text = Vec::with_capacity(CHUNK + 4096);
    let mut out = io::stdout().lock();
    let mut refused: Vec<Diag> = Vec::new();
    loop {
        items.clear();
        let step = simulator.step(&mut items);
        for item in &items {
            units_known |= matches!(item.action, Action::Units(_));
            if args.dry {
                tally.add(item);
            } else if args.format == MotionFormat::Json {
                json_line(item, simulator.state(), unknown, &mut text);
            } else {
                text::line(item, &simulator, &shown, &mut text);
            }
        }
        let new = simulator.take_warnings();
        let room = MOST_WARNINGS.saturating_sub(warnings.len());
        left_out += new.len().saturating_sub(room);
        warnings.extend(new.into_iter().take(room));
        if text.len() >= CHUNK && !write(&mut out, &mut text)? {
            return Ok(Ending::Clean);
        }
        match step {
            Ok(true) => {}
            Ok(false) => break,
            Err(RunError::Refused(diag, line)) => {
                if args.format == MotionFormat::Json {
                    let row = serde_json::json!({ "line": line, "error": diag.code.name(), "message": diag.message });
                    text.extend_from_slice(row.to_string().as_bytes());
                    text.push(b'\n');
                }
                refused.push(*diag);
                if refused.len() == MOST_REFUSED || !simulator.pass_over() {
                    break;
                }
            }
            Err(RunError::Io(error)) => return Err(io_message("read", &args.program, &error)),
        }
    }
    let name = files::name(&args.program);
    let fitting = |machine| Fitting { machine, settings, known: Known::default(), program: &name };
    let fitting = machine.as_ref().filter(|_| refused.is_empty()).map(fitting);
    let fitted = fitting.as_ref().map(|fitting| fitting.fitted(on_machine)).transpose()?;
    if args.dry {
        let times = fitted.as_ref().and_then(|fitted| fitted.times.as_ref().ok());
        let summary = match args.format {
            MotionFormat::Text => {
                let on_machine = fitting.as_ref().zip(times).map(|(fitting, times)| fitting.time(times));
                summary::describe(&tally, simulator.blocks()) + &on_machine.unwrap_or_default()
            }
            MotionFormat::Json => summary::counted(&tally, simulator.blocks(), times),
        };
        text.extend_from_slice(summary.as_bytes());
    }
    write(&mut out, &mut text)?;
    out.flush().or_else(ignore_closed)?;
    drop(out);
    if args.dry && !units_known && refused.is_empty() {
        message(&format!(
            "note: {name} has no unit code: its lengths are taken as millimetres\n  help: give `--units inch` if they are \
             inches"
        ));
    }
    let reporter = Reporter::new(colour);
    warnings.iter_mut().for_each(|diag| place_in(&name, diag));
    say(&reporter.text(&warnings, &[]));
    if left_out > 0 {
        message(&format!("and {left_out} more warnings"));
    }
    if let Some((fitting, fitted)) = fitting.zip(fitted) {
        fitting.show(&fitted, (&[], &[]), &reporter);
        say(&(fitting.sentences(&fitted) + &fitting.sentence(&fitted)));
        return Ok(if fitted.fits() { Ending::Clean } else { Ending::Findings });
    }
    if refused.is_empty() {
        return Ok(Ending::Clean);
    }
    refused.iter_mut().for_each(|diag| place_in(&name, diag));
    say(&reporter.text(&refused, &[]));
    if refused.len() == MOST_REFUSED {
        message(&format!("{MOST_REFUSED} blocks are refused: the rest of the program is not run"));
    }
    Ok(Ending::Findings)
}

/// Writes the text; `false`: the reader has closed the pipe.
fn write(out: &mut impl Write, text: &mut Vec<u8>) -> Result<bool, String> {
    let written = out.write_all(text);
    text.clear();
    match written {
        Ok(()) => Ok(true),
        Err(error) => ignore_closed(error).map(|()| false),
    }
}

fn ignore_closed(error: io::Error) -> Result<(), String> {
    if error.kind() == io::ErrorKind::BrokenPipe {
        return Ok(());
    }
    Err(io_message("write", Path::new("standard output"), &error))
}
