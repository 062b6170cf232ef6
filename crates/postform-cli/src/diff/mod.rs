//! `postform diff`.

mod archive;
mod html;
mod json;
mod sides;
mod text;

use std::io::{Cursor, IsTerminal, Write};
use std::path::Path;

use postform::internals::control::WithoutPoint;
use postform::internals::diff::{Ignore, Options, Program, Summary, compare};
use postform::internals::nc::{Kind, RunError, RunSettings, Unpointed, settings_for, tokens};
use postform::internals::verify::{Motions, NoMotion, compare_motions};
use postform::toolpath::Units;

use super::args::{DiffArgs, DiffFormat, Layout};
use super::colour::Colour;
use super::report::{Reporter, place_in};
use super::say::say;
use super::{Ending, many, output};
pub use sides::Side;
use sides::sides;
pub use text::unified;

/// Compares two programs; for several jobs, compares the programs of two forms for each job.
pub fn run(args: &DiffArgs, colour: Colour) -> Result<Ending, String> {
    if args.motion && args.format == DiffFormat::Html {
        return Err("error: --motion reports one difference: use --format text or json".into());
    }
    let reporter = Reporter::new(colour.on_stderr());
    if let (true, [old, new, jobs @ ..]) = (args.forms, args.files.as_slice())
        && !jobs.is_empty()
        && many::single(jobs).is_none()
    {
        return archive::run([old, new], jobs, args, colour, &reporter);
    }
    let Some([old, new]) = sides(args, &reporter)? else { return Ok(Ending::Findings) };
    let difference = match difference(args, &old, &new, colour, &reporter)? {
        Ok(difference) => difference,
        Err(ending) => return Ok(ending),
    };
    let text = match &difference.shown {
        Shown::Text(text) => text.clone(),
        Shown::Document(document) => output::json(document),
    };
    output::standard_output(|out| out.write_all(text.as_bytes()))?;
    Ok(if difference.is_none() { Ending::Clean } else { Ending::Findings })
}

/// The differences between two programs.
struct Difference {
    shown: Shown,
    /// The kind of the difference; empty if there is no difference. Programs that differ in the same words have the
    /// same kind.
    kind: String,
}

/// A difference for standard output.
enum Shown {
    Text(String),
    Document(serde_json::Value),
}

impl Difference {
    fn is_none(&self) -> bool {
        self.kind.is_empty()
    }
}

/// Compares two programs by the options. The inner `Err`: the programs can't be compared, and the reason has been
/// shown.
fn difference(
    args: &DiffArgs,
    old: &Side,
    new: &Side,
    colour: Colour,
    reporter: &Reporter,
) -> Result<Result<Difference, Ending>, String> {
    let mut options = Options { ignore: ignored(&args.ignore)?, tolerance: args.tolerance };
    let reads_both = |side: &Side| {
        // how a control reads numbers without a point does not depend on the units, which are somewhere in the program
        let settings = args.control.settings(side.control, Units::Mm);
        settings.unpointed == Unpointed::Whole
            || !settings.assumed && settings.control.traits().without_point == WithoutPoint::Units
    };
    options.ignore.points |= reads_both(old) && reads_both(new);
    if args.motion {
        return Ok(match motions(args, old, new, reporter)? {
            Outcome::Refused => {
                let (old, new) = (&old.name, &new.name);
                say(&format!("not proven: the comparison of {old} and {new} stopped before their ends\n"));
                Err(Ending::Findings)
            }
            Outcome::Compared(found) => {
                if found.has_slash {
                    let does = if args.control.block_delete { "skipped" } else { "run" };
                    say(&format!("blocks with a slash are {does}: the verdict is for one position of the switch\n"));
                }
                say(&text::verdict(old, new, &found));
                let shown = match args.format {
                    DiffFormat::Text => Shown::Text(text::motion(old, new, &found)),
                    _ => Shown::Document(json::motion(old, new, &found)),
                };
                let kind = if found.difference.is_some() { "the motions differ" } else { "" };
                Ok(Difference { shown, kind: kind.to_owned() })
            }
        });
    }
    let comparison = compare(&old.program, &new.program, &options);
    let summary = Summary::of(&comparison, &old.program, &new.program, &options.ignore);
    let shown = match args.format {
        DiffFormat::Text => Shown::Text(match columns(args.layout) {
            Some(columns) => {
                let colour = colour.on_stdout();
                text::side_by_side(old, new, &comparison, &summary, args.context, columns, colour)
            }
            None => unified(old, new, &comparison, &summary, args.context, &options, colour.on_stdout()),
        }),
        DiffFormat::Json => Shown::Document(json::document(old, new, &comparison, &summary, &options)),
        DiffFormat::Html => {
            let path = html::path([&old.program, &new.program], settings(args, old, new).1);
            Shown::Text(html::page(old, new, &comparison, &summary, args.context, &options, &path))
        }
    };
    let kind = if comparison.is_same() { String::new() } else { text::kind(&summary) };
    Ok(Ok(Difference { shown, kind }))
}

/// The width for two programs side by side; `None`: one program is shown below the other.
fn columns(layout: Layout) -> Option<usize> {
    const WIDE: usize = 140;
    let terminal = || terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    match layout {
        Layout::Unified => None,
        Layout::Side => Some(terminal().unwrap_or(WIDE)),
        Layout::Auto => terminal().filter(|&columns| columns >= WIDE && std::io::stdout().is_terminal()),
    }
}

/// Reads the names of `--ignore`.
pub fn ignored(names: &[String]) -> Result<Ignore, String> {
    let mut ignore = Ignore::default();
    for name in names {
        match name.as_str() {
            "none" => {}
            "all" => Ignore::NAMES.iter().for_each(|name| _ = ignore.set(name)),
            name if ignore.set(name) => {}
            name => {
                let known = Ignore::NAMES.join(", ");
                return Err(format!(
                    "error: --ignore has no value `{name}`\n  help: use some of {known}, or all or none"
                ));
            }
        }
    }
    Ok(ignore)
}

/// The units of the first G20 or G21 of a program.
fn units_of(program: &Program) -> Option<Units> {
    (0..program.len()).flat_map(|line| tokens(program.line(line))).find_map(|token| match token.kind {
        Kind::Word(b'G', number) if number.value == 20.0 => Some(Units::Inch),
        Kind::Word(b'G', number) if number.value == 21.0 => Some(Units::Mm),
        _ => None,
    })
}

enum Outcome {
    Compared(Motions),
    Refused,
}

/// The run settings of both programs.
fn settings(args: &DiffArgs, old: &Side, new: &Side) -> (Units, [RunSettings; 2]) {
    // the units until a program sets its own units: those of --units, else those of the first G20 or G21 in one of the
    // programs, else millimetres
    let said = || units_of(&old.program).or_else(|| units_of(&new.program));
    let units = args.options.units.map(|units| units.units()).or_else(said).unwrap_or(Units::Mm);
    (units, [old, new].map(|side| args.control.settings(side.control, units)))
}

/// Compares the motions of both programs.
fn motions(args: &DiffArgs, old: &Side, new: &Side, reporter: &Reporter) -> Result<Outcome, String> {
    let (units, settings) = settings(args, old, new);
    let tolerance = if args.tolerance > 0.0 { args.tolerance } else { 1e-6 };
    let inputs = [old, new].map(|side| Cursor::new(side.program.bytes()));
    let failed = |error: std::io::Error| format!("error: can't read the program: {error}");
    let [mut a, mut b] = inputs;
    let settings = [
        settings_for(&mut a, Path::new(&old.name), settings[0]).map_err(failed)?,
        settings_for(&mut b, Path::new(&new.name), settings[1]).map_err(failed)?,
    ];
    match compare_motions([(a, settings[0]), (b, settings[1])], units, tolerance) {
        Ok(found) => Ok(Outcome::Compared(found)),
        Err(NoMotion(which, RunError::Refused(mut diag, _))) => {
            place_in(if which == 0 { &old.name } else { &new.name }, &mut diag);
            say(&reporter.text(&[*diag], &[]));
            Ok(Outcome::Refused)
        }
        Err(NoMotion(_, RunError::Io(error))) => Err(failed(error)),
    }
}
