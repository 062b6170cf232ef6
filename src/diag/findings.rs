//! Findings with the text that they are about.

use std::fmt;

use super::{Diag, Severity};
use crate::source::Source;
use crate::terminal::escaped;

/// What was found, with the form's text: enough to show it or to write a report of it.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Findings in the order of the files and of the places in them.
    pub diags: Vec<Diag>,
    /// The form, and those that it calls: the spans of labels and fixes are places in them. Empty where no form is concerned.
    pub files: Vec<Source>,
    /// How many findings more there are that comments of the form allow.
    pub suppressed: usize,
}

impl Findings {
    /// Are there no findings?
    pub fn is_empty(&self) -> bool {
        self.diags.is_empty()
    }

    /// How many findings have this severity.
    pub fn count(&self, severity: Severity) -> usize {
        self.diags.iter().filter(|diag| diag.severity == severity).count()
    }
}

impl fmt::Display for Findings {
    /// A line each: `form.pf:13:6: warning PF426: .. (print G43 before it)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.diags.iter().map(|diag| diag.line(&self.files)).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl Diag {
    /// The finding in one line, without a line end: place, severity, code, message and help. `files` are those of its form.
    pub fn line(&self, files: &[Source]) -> String {
        let in_form = self.labels.first().and_then(|label| {
            let source = files.get(label.span.file as usize)?;
            let (line, column) = source.line_column(label.span.start);
            Some(format!("{}:{line}:{column}", source.name))
        });
        let place =
            in_form.or_else(|| self.place.as_ref().map(|place| place.to_string())).filter(|place| !place.is_empty());
        let place = place.map(|place| place + ": ").unwrap_or_default();
        let help = self.help.as_ref().map(|help| format!(" ({help})")).unwrap_or_default();
        format!("{place}{} {}: {}{help}", self.severity.name(), self.code.name(), self.message)
    }

    /// The line of the form that the finding is about, with a mark under the words: two lines without an end. `None`: it is
    /// about no form. `files` are those of the form.
    pub(crate) fn marked(&self, files: &[Source]) -> Option<String> {
        let span = self.labels.first()?.span;
        let source = files.get(span.file as usize)?;
        let (line, column) = source.line_column(span.start);
        let text = source.text.lines().nth(line as usize - 1)?;
        let before: String = text.chars().take(column as usize - 1).map(|c| if c == '\t' { c } else { ' ' }).collect();
        let rest = text.chars().count().saturating_sub(column as usize - 1);
        let marks = "^".repeat(source.slice(span).chars().count().clamp(1, rest.max(1)));
        let margin = " ".repeat(line.to_string().len());
        Some(format!("{line} | {}\n{margin} | {before}{marks}", escaped(text)))
    }
}
