//! A finding as a row, for the packages for other languages.

use serde::Serialize;

use crate::diag::Diag;
use crate::source::Source;

/// A finding with its position as values.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The code of the finding: `PF101`.
    pub code: &'static str,
    /// `error`, `warning` or `note`.
    pub severity: &'static str,
    /// What is wrong.
    pub message: String,
    /// A proposed fix, in words.
    pub help: Option<String>,
    /// The form, job or program.
    pub file: Option<String>,
    /// The line, from 1.
    pub line: Option<u64>,
    /// The column in bytes, from 1.
    pub column: Option<u32>,
    /// The position in a job: `operations[0].path[3]`.
    pub path: Option<String>,
    /// The line of the program, from 1.
    pub program_line: Option<u64>,
    /// The whole finding in one line.
    pub text: String,
}

/// The row of a finding; `files` are the files of its form.
pub fn row(diag: &Diag, files: &[Source]) -> Row {
    let place = diag.place.clone().unwrap_or_default();
    let in_form = diag.labels.first().and_then(|label| {
        let source = files.get(label.span.file as usize)?;
        let (line, column) = source.line_column(label.span.start);
        Some((Some(source.name.clone()), Some(line as u64), Some(column)))
    });
    let (file, line, column) = in_form.unwrap_or((place.file, place.line, place.column));
    Row {
        code: diag.code.name(),
        severity: diag.severity.name(),
        message: diag.message.clone(),
        help: diag.help.clone(),
        file,
        line,
        column,
        path: place.step,
        program_line: place.program_line,
        text: diag.line(files),
    }
}
