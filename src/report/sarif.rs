//! Findings as a SARIF 2.1.0 log, which code hosts and editors read.

use serde_json::{Value, json};

use crate::diag::{CODES, CodeRow, Diag, Findings, Severity};
use crate::source::Source;
use crate::span::Span;

/// The whole log; `all_read`: no form was skipped.
pub fn log<'a>(forms: impl Iterator<Item = &'a Findings>, all_read: bool) -> Value {
    let rules: Vec<&CodeRow> = CODES.iter().filter(|row| row.name.starts_with("PF")).collect();
    let described: Vec<Value> = rules
        .iter()
        .map(|row| {
            json!({
                "id": row.name,
                "shortDescription": { "text": row.title },
                "help": { "text": format!("postform explain {}", row.name) },
                "defaultConfiguration": { "level": level(row.severity) },
            })
        })
        .collect();
    let of_form =
        |form: &Findings| -> Vec<Value> { form.diags.iter().map(|diag| result(diag, &form.files, &rules)).collect() };
    let results: Vec<Value> = forms.flat_map(of_form).collect();
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": { "name": "postform", "version": env!("CARGO_PKG_VERSION"), "rules": described } },
            "columnKind": "unicodeCodePoints",
            "invocations": [{ "executionSuccessful": all_read }],
            "results": results,
        }],
    })
}

fn result(diag: &Diag, files: &[Source], rules: &[&CodeRow]) -> Value {
    let text = match &diag.help {
        Some(help) => format!("{}. {help}", diag.message),
        None => diag.message.clone(),
    };
    let mut result = json!({
        "ruleId": diag.code.name(),
        "ruleIndex": rules.iter().position(|row| row.code == diag.code),
        "level": level(diag.severity),
        "message": { "text": text },
        "locations": diag.labels.iter().take(1).filter_map(|label| location(label.span, files, None)).collect::<Vec<_>>(),
    });
    let related: Vec<Value> =
        diag.labels.iter().skip(1).filter_map(|label| location(label.span, files, Some(&label.text))).collect();
    if !related.is_empty() {
        result["relatedLocations"] = related.into();
    }
    if let Some(fix) = &diag.fix {
        let changes: Vec<Value> =
            fix.edits.chunk_by(|(a, _), (b, _)| a.file == b.file).filter_map(|edits| change(edits, files)).collect();
        result["fixes"] = json!([{ "description": { "text": fix.title }, "artifactChanges": changes }]);
    }
    result
}

/// The edits of one file.
fn change(edits: &[(Span, String)], files: &[Source]) -> Option<Value> {
    let source = files.get(edits.first()?.0.file as usize)?;
    let replace = |(span, text): &(Span, String)| json!({ "deletedRegion": region(*span, source), "insertedContent": { "text": text } });
    let replacements: Vec<Value> = edits.iter().map(replace).collect();
    Some(json!({ "artifactLocation": { "uri": uri(&source.name) }, "replacements": replacements }))
}

fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    }
}

fn location(span: Span, files: &[Source], text: Option<&str>) -> Option<Value> {
    let source = files.get(span.file as usize)?;
    let mut location = json!({
        "physicalLocation": { "artifactLocation": { "uri": uri(&source.name) }, "region": region(span, source) },
    });
    if let Some(text) = text {
        location["message"] = json!({ "text": text });
    }
    Some(location)
}

fn region(span: Span, source: &Source) -> Value {
    let (line, column) = source.line_column(span.start);
    let (end_line, end_column) = source.line_column(span.end);
    json!({ "startLine": line, "startColumn": column, "endLine": end_line, "endColumn": end_column })
}

/// A file's name as a relative reference.
fn uri(name: &str) -> String {
    let mut uri = String::with_capacity(name.len());
    for byte in name.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' | b'~' => uri.push(char::from(byte)),
            b'\\' => uri.push('/'),
            _ => uri += &format!("%{byte:02X}"),
        }
    }
    uri
}
