//! `postform lint`.

use std::io::Write;

use postform::lint::lint;

use super::args::{Format, LintArgs};
use super::colour::Colour;
use super::report::{Reporter, count};
use super::{Ending, forms, json, output};

/// Every finding of every form.
pub fn run(args: &LintArgs, colour: Colour) -> Ending {
    let reporter = Reporter::new(colour.on_stdout());
    let (mut totals, mut failed) = ([0; 3], false);
    let (mut text, mut findings) = (String::new(), Vec::new());
    for path in &args.forms {
        let checked = match forms::load(path, args.limits) {
            Ok(checked) => checked,
            Err(message) => {
                eprintln!("{message}");
                failed = true;
                continue;
            }
        };
        let diags = lint(&checked);
        for (total, count) in totals.iter_mut().zip(json::counts(&diags)) {
            *total += count;
        }
        match args.format {
            Format::Pretty => text += &reporter.text(&diags, &checked.files),
            Format::Json => findings.extend(diags.iter().map(|diag| json::finding(diag, &checked.files))),
        }
    }
    let [errors, warnings, notes] = totals;
    match args.format {
        Format::Json => text = format!("{:#}\n", json::report(findings, totals)),
        Format::Pretty => {
            let (errors, warnings) = (count(errors, "error"), count(warnings, "warning"));
            text += &format!("{errors}, {warnings}, {}\n", count(notes, "note"));
        }
    }
    if let Err(message) = output::standard_output(|out| out.write_all(text.as_bytes())) {
        eprintln!("{message}");
        failed = true;
    }
    match (failed, errors + warnings) {
        (true, _) => Ending::Failed,
        (_, 0) => Ending::Clean,
        _ => Ending::Findings,
    }
}
