//! The findings of a text, for the editor.

use std::io::Cursor;

use gen_lsp_types as lsp;
use postform::diag::{Diag, Location};
use postform::internals::control::Control;
use postform::internals::ide::program;
use postform::internals::preflight::{Known, preflight};
use postform::{Finding, Job, RunSettings, Source, Unpointed};

use super::convert::{diagnostic, line, range, trouble};
use super::server::Server;
use super::texts::{Kind, Text};
use super::view::View;
use crate::config::Config;
use crate::machine;

/// Maximum number of findings of one text that are sent.
const MOST: usize = 1000;

/// The findings of an open text.
pub fn of(text: &Text, server: &Server) -> Vec<lsp::Diagnostic> {
    let mut found = match text.kind {
        Kind::Form => server.view(&text.uri).map(|view| form(&view, server)).unwrap_or_default(),
        Kind::Program => nc(text, server),
        Kind::Settings => settings(text),
        Kind::Other => job(text, server),
    };
    found.truncate(MOST);
    found
}

/// The findings of a form: those of lint, with the levels of the form's folder.
fn form(view: &View, server: &Server) -> Vec<lsp::Diagnostic> {
    let mut found: Vec<lsp::Diagnostic> = view.trouble.iter().map(|message| trouble(message, line(0))).collect();
    for (index, diag) in view.document.findings().iter().enumerate() {
        let Some(label) = diag.labels.first() else { continue };
        let (span, place) = match label.span.file == view.file {
            true => (label.span, None),
            // a finding in a called file is shown at the call
            false => match diag.labels.iter().find(|other| other.span.file == view.file) {
                Some(other) => (other.span, Some(label.span)),
                None if view.file == 0 => (call_of(view, label.span.file), Some(label.span)),
                None => continue,
            },
        };
        let mut shown = diagnostic(diag, range(view.source(), span), "postform");
        let others = diag.labels.iter().skip(1).map(|label| (label.span, label.text.clone()));
        let others = place.map(|span| (span, "found here".to_owned())).into_iter().chain(others);
        let related = others.filter_map(|(span, message)| {
            let uri = view.uri(span.file, &server.texts)?;
            let source = view.document.files().get(span.file as usize)?;
            Some(lsp::DiagnosticRelatedInformation {
                location: lsp::Location { uri, range: range(source, span) },
                message,
            })
        });
        let related: Vec<_> = related.collect();
        shown.related_information = (!related.is_empty()).then_some(related);
        shown.data = Some(index.into());
        found.push(shown);
    }
    found
}

/// The line of the form that calls a file, directly or through other files; the beginning of the form if there is none.
fn call_of(view: &View, file: u32) -> postform::Span {
    let calls = &view.document.checked().calls;
    let mut line = calls.iter().find(|(_, called)| *called == file);
    while let Some((span, _)) = line.filter(|(span, _)| span.file != 0) {
        line = calls.iter().find(|(_, called)| *called == span.file);
    }
    line.map(|(span, _)| *span).unwrap_or_default()
}

/// The findings of a program: the errors and warnings of its control.
fn nc(text: &Text, server: &Server) -> Vec<lsp::Diagnostic> {
    let (control, mut found) = match server.control_of(text) {
        Ok((control, _)) => (control, Vec::new()),
        Err(message) => (Control::usual(), vec![trouble(&message, line(0))]),
    };
    let checked = program::check(&text.source.text, control);
    let by = format!("postform ({})", control.name());
    found.extend(checked.diags.iter().map(|diag| at_location(diag, &text.source, &by)));
    if !checked.cut && checked.refused == 0 {
        found.extend(fits(text, control));
    }
    found
}

/// The findings of the check whether a program fits into the machine in the folder's postform.toml.
fn fits(text: &Text, control: &'static Control) -> Vec<lsp::Diagnostic> {
    let Some(path) = text.path.as_deref() else { return Vec::new() };
    let Some(file) = Config::near(path).ok().and_then(|config| config.machine) else { return Vec::new() };
    let machine = match machine::read(&file) {
        Ok(machine) => machine,
        Err(message) => return vec![trouble(&message, line(0))],
    };
    let settings = RunSettings { unpointed: Unpointed::Whole, ..RunSettings::new(control) };
    let Ok(fitted) = preflight(Cursor::new(text.source.text.as_bytes()), settings, &machine, &Known::default()) else {
        return Vec::new();
    };
    let of = |finding: &Finding| {
        let mut diag = Diag::new(finding.code, finding.message.as_str()).help(finding.help);
        diag = diag.place(Location::line(finding.line.max(1)));
        at_location(&diag, &text.source, &machine.name)
    };
    fitted.findings.iter().map(of).collect()
}

fn at_location(diag: &Diag, source: &Source, by: &str) -> lsp::Diagnostic {
    let span = diag.place.as_ref().map(|location| program::place(source, location)).unwrap_or_default();
    diagnostic(diag, range(source, span), by)
}

/// The findings of a job in the folder's postform.toml: the errors of the job, and the parts of the job that the form
/// can't print.
fn job(text: &Text, server: &Server) -> Vec<lsp::Diagnostic> {
    let Some(path) = text.path.as_deref() else { return Vec::new() };
    let Ok(config) = Config::near(path) else { return Vec::new() };
    let own = path.canonicalize().ok();
    if own.is_none() || !config.jobs.iter().any(|job| job.canonicalize().ok() == own) {
        return Vec::new();
    }
    let Ok(mut job) = Job::open(&path.to_string_lossy(), &text.source.text) else { return Vec::new() };
    let view = config.form.as_deref().and_then(|form| server.view_of_form(form));
    let printed = view.as_ref().and_then(|view| view.document.print("job", job.again()));
    let mut diags = Vec::new();
    match &printed {
        Some(current) => {
            diags.extend(current.notes().iter().cloned());
            diags.extend(current.stopped().into_iter().flat_map(|error| error.findings().diags.clone()));
        }
        None => {
            let mut events = postform::toolpath::Summary::default();
            let read = job.read(&mut events);
            diags.extend(job.report().warnings.iter().cloned());
            diags.extend(read.err().into_iter().flat_map(|error| error.into_findings().diags));
            diags.extend(events.unprintable());
        }
    }
    diags.dedup();
    let source = &text.source;
    let in_job = |diag: &Diag| {
        let at = diag.place.as_ref().and_then(|place| place.line).unwrap_or(1).saturating_sub(1);
        let start = source.line_starts().get(at as usize).copied().unwrap_or(0);
        let column = diag.place.as_ref().and_then(|place| place.column).unwrap_or(1).saturating_sub(1);
        let rest = &source.text[start as usize..];
        let line = rest.lines().next().unwrap_or("");
        let from = start + column.min(line.len() as u32);
        let to = start + line.trim_end().len() as u32;
        diagnostic(diag, range(source, postform::Span { file: 0, start: from, end: to.max(from) }), "postform")
    };
    diags.iter().map(in_job).collect()
}

/// The errors of postform.toml.
fn settings(text: &Text) -> Vec<lsp::Diagnostic> {
    let Some(path) = text.path.as_deref() else { return Vec::new() };
    let Err(message) = Config::from_text(path, &text.source.text) else { return Vec::new() };
    // the error contains `at line 3, column 5`
    let number = message.split("at line ").nth(1).and_then(|rest| rest.split(|c: char| !c.is_ascii_digit()).next());
    let number = number.and_then(|digits| digits.parse::<u32>().ok()).unwrap_or(1);
    vec![trouble(&message, line(number.saturating_sub(1)))]
}
