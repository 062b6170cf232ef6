//! Findings for programs: JSON, version 1 (docs/lint.schema.json).

use serde_json::{Value, json};

use postform::diag::{Diag, Location};
use postform::source::Source;
use postform::span::Span;

use super::{Counts, Linted};

/// The whole report.
pub fn report(linted: &[Linted], counts: Counts) -> Value {
    let findings: Vec<Value> = linted.iter().flat_map(findings).collect();
    json!({
        "version": 1,
        "findings": findings,
        "summary": {
            "errors": counts.errors,
            "warnings": counts.warnings,
            "notes": counts.notes,
            "suppressed": counts.suppressed,
            "unread": counts.unread,
        },
    })
}

fn findings(form: &Linted) -> impl Iterator<Item = Value> + '_ {
    form.diags.iter().map(|diag| finding(diag, &form.files))
}

/// A place in a job or a program.
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
        "job": diag.place.as_ref().map(Location::to_string),
        "place": diag.place.as_ref().map(location),
        "help": diag.help,
        "fix": fix,
    })
}
