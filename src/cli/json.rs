//! Findings for programs: JSON, version 1.

use serde_json::{Value, json};

use postform::diag::{Diag, Severity};
use postform::source::Source;
use postform::span::Span;

/// One finding.
pub fn finding(diag: &Diag, files: &[Source]) -> Value {
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
        "job": diag.place,
        "help": diag.help,
        "fix": fix,
    })
}

/// The whole report.
pub fn report(findings: Vec<Value>, counts: [usize; 3]) -> Value {
    let [errors, warnings, notes] = counts;
    json!({
        "version": 1,
        "findings": findings,
        "summary": { "errors": errors, "warnings": warnings, "notes": notes },
    })
}

/// How many errors, warnings and notes.
pub fn counts(diags: &[Diag]) -> [usize; 3] {
    [Severity::Error, Severity::Warning, Severity::Note].map(|s| diags.iter().filter(|d| d.severity == s).count())
}
