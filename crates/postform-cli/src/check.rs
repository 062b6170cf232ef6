//! `postform check`.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use postform::Format;
use postform::diag::Diag;
use postform::internals::cl::{Dialect, Report, Setup};
use postform::internals::json::SCHEMA;
use postform::toolpath::{Summary, Units};

use super::args::CheckArgs;
use super::files;
use super::report::{Reporter, place_in, stopped};
use super::say::say;
use super::{Ending, many, output};

/// Reads jobs and prints summaries of them.
pub fn run(args: &CheckArgs, colour: bool) -> Result<Ending, String> {
    if args.schema {
        return output::shown(|out| out.write_all(SCHEMA.as_bytes()));
    }
    let reporter = &Reporter::new(colour);
    if let Some(job) = many::single(&args.jobs) {
        files::check_format(job, &args.read)?;
        let (text, ending) = checked(job, args, reporter)?;
        output::standard_output(|out| out.write_all(text.as_bytes()))?;
        return Ok(ending);
    }
    let jobs = many::jobs(&args.jobs)?;
    files::check_formats(&jobs, &args.read)?;
    many::run(None, jobs, |job| files::name(job), "job", |job| checked(job, args, reporter))
}

/// The summary of a job, as text for standard output.
fn checked(path: &Path, args: &CheckArgs, reporter: &Reporter) -> Result<(String, Ending), String> {
    let mut summary = Summary::default();
    let mut job = files::job(path, &args.read, true)?;
    // a file that can't be read has no setups to list
    let setups = job.setups().unwrap_or_default();
    let read = job.read(&mut summary);
    let report = job.report();
    let placed = |mut diag: Diag| {
        place_in(&files::name(path), &mut diag);
        diag
    };
    let warnings: Vec<Diag> = report.warnings.iter().cloned().map(placed).collect();
    say(&reporter.text(&warnings, &[]));
    match read {
        Ok(()) => {
            let unprintable: Vec<Diag> = summary.unprintable().into_iter().map(placed).collect();
            let text = describe(&files::name(path), job.format(), &summary, report) + &listed(&setups);
            say(&reporter.text(&unprintable, &[]));
            Ok((text, unprintable.first().map_or(Ending::Clean, Ending::of)))
        }
        Err(error) => Ok((listed(&setups), stopped(error, &[path], reporter, &[])?)),
    }
}

/// Maximum number of setups that are listed.
const MOST_SETUPS: usize = 12;

/// The setups of a file with several tool directions, or with a tool direction other than up.
fn listed(setups: &[Setup]) -> String {
    if setups.iter().all(|setup| setup.axis == [0.0, 0.0, 1.0]) {
        return String::new();
    }
    let mut text: String = setups
        .iter()
        .take(MOST_SETUPS)
        .enumerate()
        .map(|(i, setup)| format!("  --setup {:<3} {setup}\n", i + 1))
        .collect();
    if setups.len() > MOST_SETUPS {
        _ = writeln!(text, "              and more: the tool axis changes continuously");
    }
    text
}

/// The summary as text for a machinist.
fn describe(name: &str, format: Format, summary: &Summary, report: &Report) -> String {
    let mut text = String::new();
    let unit = summary.units.map_or("", Units::name);
    _ = writeln!(text, "{name}: {}", if summary.unprintable().is_empty() { "in order" } else { "can't be printed" });
    if let Some(job) = &summary.name {
        _ = writeln!(text, "  name        {}", postform::internals::terminal::escaped(job));
    }
    if let Some(program) = summary.program {
        _ = writeln!(text, "  program     {program}");
    }
    if format == Format::Cl && !(report.facts.is_empty() && report.dialect.is_none() && report.why.is_empty()) {
        let system = report.dialect.unwrap_or(Dialect::Gener).title();
        let why = if report.why.is_empty() { "the file does not name its CAM system" } else { &report.why };
        _ = writeln!(text, "  written by  {system}: {}", postform::internals::terminal::escaped(why));
    }
    _ = writeln!(text, "  units       {unit}");
    let tools: Vec<String> = summary
        .tools
        .iter()
        .map(|(number, diameter)| match diameter {
            Some(diameter) => format!("T{number} (diameter {diameter})"),
            None => format!("T{number}"),
        })
        .collect();
    _ = writeln!(text, "  tools       {}", if tools.is_empty() { "none".into() } else { tools.join(", ") });
    _ = writeln!(text, "  operations  {}", summary.operations);
    _ = writeln!(text, "  moves       {} rapid, {} straight, {} arcs", summary.rapids, summary.lines, summary.arcs);
    let holes: Vec<String> = summary.holes.iter().map(|(kind, count)| format!("{count} {}", kind.name())).collect();
    _ = writeln!(text, "  holes       {}", if holes.is_empty() { "none".into() } else { holes.join(", ") });
    if summary.tilts > 0 {
        _ = writeln!(text, "  tool axis   changes {} times", summary.tilts);
    }
    for (axis, extent) in ["h", "v", "d"].iter().zip(&summary.extents) {
        if let Some((least, greatest)) = extent {
            let [least, greatest] = [least, greatest].map(|length| (length * 1e6).round() / 1e6);
            _ = writeln!(text, "  {axis}           {least} to {greatest} {unit}");
        }
    }
    for fact in &report.facts {
        _ = writeln!(text, "  says        {}", postform::internals::terminal::escaped(fact));
    }
    text
}
