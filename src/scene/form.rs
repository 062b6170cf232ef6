//! The form and its findings.

use serde_json::{Map, Value, json};

use crate::diag::{Diag, Location, Severity, suggestion};
use crate::post::shipped::FORMS;
use crate::sema::{Checked, Property, PropertyKind};
use crate::source::Source;
use crate::span::Span;

/// Maximum number of findings that are shown. More findings at once do not help a reader.
const MOST: usize = 500;

/// The files of a form, the findings of lint, the lines of the letter formats, and the properties. For a form without
/// text, the posts that come with postform are added, because a new form may begin with one of these posts.
pub fn form(checked: &Checked, diags: &[Diag], suppressed: usize) -> Value {
    let files = checked.files.as_slice();
    let count = |severity| diags.iter().filter(|diag| diag.severity == severity).count();
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    let formats = checked.form.formats.iter();
    let formats =
        formats.filter_map(|(letter, (_, span))| Some((char::from(*letter).to_string(), place(*span, files)?)));
    json!({
        "files": names,
        "findings": diags.iter().take(MOST).map(|diag| finding(diag, files)).collect::<Vec<Value>>(),
        "errors": count(Severity::Error),
        "warnings": count(Severity::Warning),
        "notes": count(Severity::Note),
        "suppressed": suppressed,
        "formats": formats.collect::<Map<String, Value>>(),
        "properties": checked.form.settings.properties.iter().filter(|own| own.of_tool().is_none()).map(property).collect::<Vec<Value>>(),
        "kit": files.first().filter(|file| file.text.trim().is_empty()).map(|_| kit()),
    })
}

fn property(property: &Property) -> Value {
    let choices = match &property.kind {
        PropertyKind::Choice(words) => words.clone(),
        PropertyKind::YesNo => vec!["yes".to_owned(), "no".to_owned()],
        _ => Vec::new(),
    };
    json!({
        "name": property.name,
        "kind": property.kind.name(),
        "choices": choices,
        "default": property.default.to_string(),
        "text": property.text,
    })
}

fn kit() -> Value {
    let rows = FORMS.iter().map(|post| json!({ "name": post.name, "about": post.about, "text": post.text }));
    rows.collect()
}

/// A finding with its location and its fix.
pub fn finding(diag: &Diag, files: &[Source]) -> Value {
    let labels: Vec<Value> = diag
        .labels
        .iter()
        .filter_map(|label| Some(json!({ "at": place(label.span, files)?, "text": label.text })))
        .collect();
    let fix = diag.fix.as_deref().cloned().or_else(|| suggestion(diag, files)).map(|fix| {
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
        "place": diag.place.as_deref().map(Location::to_string),
        "fix": fix,
    })
}

/// A span as file, first line and column, last line and column. Lines are counted from 0, columns in UTF-16 units, as
/// by the editor in the browser.
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
