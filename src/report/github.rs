//! Findings as annotations of GitHub's workflows, one per line; GitHub shows them beside the form's line.

use crate::diag::{Findings, Severity};

/// One line per finding.
pub fn annotations(form: &Findings) -> String {
    let mut text = String::new();
    for diag in &form.diags {
        let kind = match diag.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "notice",
        };
        let place = diag.labels.first().and_then(|label| {
            let source = form.files.get(label.span.file as usize)?;
            let (line, column) = source.line_column(label.span.start);
            let (end_line, end_column) = source.line_column(label.span.end);
            let file = property(&source.name);
            // columns are valid only within one line
            let columns = match line == end_line {
                true => format!(",col={column},endColumn={end_column}"),
                false => String::new(),
            };
            Some(format!("file={file},line={line},endLine={end_line}{columns},"))
        });
        let help = diag.help.as_ref().map(|help| format!("\nhelp: {help}")).unwrap_or_default();
        let message = data(&format!("{}{help}", diag.message));
        text += &format!("::{kind} {}title={}::{message}\n", place.unwrap_or_default(), diag.code.name());
    }
    text
}

/// Text after the second `::`.
pub fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The value of a property.
pub fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
