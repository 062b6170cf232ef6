//! The form and its findings.

use serde_json::{Value, json};

use crate::diag::{Diag, Location, Severity};
use crate::source::Source;
use crate::span::Span;

/// Findings that are shown: nobody reads more of them at once.
const MOST: usize = 500;

/// The files of a form, and what lint found.
pub fn form(files: &[Source], diags: &[Diag], suppressed: usize) -> Value {
    let count = |severity| diags.iter().filter(|diag| diag.severity == severity).count();
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    json!({
        "files": names,
        "findings": diags.iter().take(MOST).map(|diag| finding(diag, files)).collect::<Vec<Value>>(),
        "errors": count(Severity::Error),
        "warnings": count(Severity::Warning),
        "notes": count(Severity::Note),
        "suppressed": suppressed,
    })
}

/// A finding, where it is, and what fixes it.
pub fn finding(diag: &Diag, files: &[Source]) -> Value {
    let labels: Vec<Value> = diag
        .labels
        .iter()
        .filter_map(|label| Some(json!({ "at": place(label.span, files)?, "text": label.text })))
        .collect();
    let fix = diag.fix.as_ref().map(|fix| {
        let edits =
            fix.edits.iter().filter_map(|(span, text)| Some(json!({ "at": place(*span, files)?, "text": text })));
        json!({ "title": fix.title, "safe": fix.safe, "edits": edits.collect::<Vec<Value>>() })
    });
    json!({
        "code": diag.code.name(),
        "severity": diag.severity.name(),
        "message": diag.message,
        "help": diag.help,
        "labels": labels,
        "place": diag.place.as_ref().map(Location::to_string),
        "fix": fix,
    })
}

/// File, first and last line and column: lines from 0, columns in UTF-16 units, as an editor in a browser counts.
pub fn place(span: Span, files: &[Source]) -> Option<Value> {
    let source = files.get(span.file as usize)?;
    let at = |byte: u32| {
        let line = source.line(byte);
        let start = source.line_starts().get(line).copied().unwrap_or(0) as usize;
        let before = source.text.get(start..byte as usize).unwrap_or("");
        [line, before.encode_utf16().count()]
    };
    let ([line, column], [end_line, end_column]) = (at(span.start), at(span.end));
    Some(json!([span.file, line, column, end_line, end_column]))
}
