//! Findings as JSON for other programs, version 1 (docs/lint.schema.json).

use serde_json::{Value, json};

use crate::diag::{Diag, Findings, Location, Severity};
use crate::source::Source;
use crate::span::Span;

/// The whole report; `unread`: forms that could not be read.
pub fn report<'a>(forms: impl Iterator<Item = &'a Findings> + Clone, unread: usize) -> Value {
    let all = forms.clone().flat_map(|form| form.diags.iter().map(|diag| finding(diag, &form.files)));
    let count = |severity| forms.clone().map(|form| form.count(severity)).sum::<usize>();
    json!({
        "version": 1,
        "findings": all.collect::<Vec<Value>>(),
        "summary": {
            "errors": count(Severity::Error),
            "warnings": count(Severity::Warning),
            "notes": count(Severity::Note),
            "suppressed": forms.clone().map(|form| form.suppressed).sum::<usize>(),
            "unread": unread,
        },
    })
}

/// A location in a job or a program.
fn location(place: &Location) -> Value {
    json!({
        "file": place.file, "line": place.line, "column": place.column, "step": place.step,
        "program_line": place.program_line,
    })
}

fn finding(diag: &Diag, files: &[Source]) -> Value {
    let place = |span: Span| match files.get(span.file as usize) {
        Some(source) => {
            let (line, column) = source.line_column(span.start);
            let (end_line, end_column) = source.line_column(span.end);
            json!({
                "file": source.name, "line": line, "column": column, "end_line": end_line, "end_column": end_column,
                "start": span.start, "end": span.end,
            })
        }
        None => Value::Null,
    };
    let labels: Vec<Value> =
        diag.labels.iter().map(|label| json!({ "at": place(label.span), "text": label.text })).collect();
    let fix = diag.fix.as_ref().map(|fix| {
        let edits: Vec<Value> =
            fix.edits.iter().map(|(span, text)| json!({ "at": place(*span), "text": text })).collect();
        json!({ "title": fix.title, "safe": fix.safe, "edits": edits })
    });
    json!({
        "code": diag.code.name(),
        "severity": diag.severity.name(),
        "message": diag.message,
        "at": diag.labels.first().map_or(Value::Null, |label| place(label.span)),
        "labels": labels,
        "job": diag.place.as_deref().map(Location::to_string),
        "place": diag.place.as_deref().map(location),
        "help": diag.help,
        "fix": fix,
    })
}
