//! Findings with the text of the form.

use std::fmt;

use super::{Diag, Severity};
use crate::source::Source;
use crate::terminal::escaped;

/// Findings with the form's text: all data that is needed to display the findings or to write a report.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Findings in the order of the files and of the locations in them.
    pub diags: Vec<Diag>,
    /// The form and the forms that it calls. The spans of labels and fixes refer to these files. Empty if no form is involved.
    pub files: Vec<Source>,
    /// Number of further findings that comments in the form suppress.
    pub suppressed: usize,
}

impl Findings {
    /// Whether there are no findings.
    pub fn is_empty(&self) -> bool {
        self.diags.is_empty()
    }

    /// Number of findings with this severity.
    pub fn count(&self, severity: Severity) -> usize {
        self.diags.iter().filter(|diag| diag.severity == severity).count()
    }
}

impl fmt::Display for Findings {
    /// Writes one line per finding: `form.pf:13:6: warning PF426: .. (print G43 before it)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.diags.iter().map(|diag| diag.line(&self.files)).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl Diag {
    /// The finding in one line, without a line end: location, severity, code, message and help. `files` are the files of the form.
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

    /// Two lines without a final line end: the form line of the finding, and a line with a mark under the words of the
    /// finding. `None`: the finding is not in a form. `files` are the files of the form.
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
