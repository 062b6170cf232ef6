//! Printed programs.

use crate::diag::Diag;
use crate::render::TraceLine;
use crate::verify::Verdict;

/// A complete program.
#[derive(Clone, Debug)]
pub struct Program {
    pub(super) text: String,
    pub(super) rendered: Rendered,
    pub(super) trace: Vec<TraceLine>,
    pub(super) verdict: Verdict,
}

impl Program {
    /// The text of the program.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Converts the program into its text.
    pub fn into_text(self) -> String {
        self.text
    }

    /// The verdict on the program. It is never [`Verdict::Different`]: such a program is an error.
    pub fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    /// Warnings and notes of the job and of printing it, each kind once.
    pub fn notes(&self) -> &[Diag] {
        &self.rendered.notes
    }

    /// The notes, and the findings of the verdict: differences, or parts that are not proven.
    #[doc(hidden)]
    pub fn findings(&self) -> Vec<Diag> {
        [self.rendered.notes.clone(), self.verdict.diags("the program")].concat()
    }

    /// The file name from form and job.
    #[doc(hidden)]
    pub fn file_name(&self) -> &str {
        &self.rendered.file_name
    }

    /// The form line and the item of the job that printed each line. Empty unless [`Options::trace`](super::Options::trace) is
    /// set.
    pub fn trace(&self) -> &[TraceLine] {
        &self.trace
    }
}

impl AsRef<str> for Program {
    fn as_ref(&self) -> &str {
        &self.text
    }
}

/// Result of printing a program to an output.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Rendered {
    /// Warnings and notes of the job and of printing it, each kind once.
    pub notes: Vec<Diag>,
    /// Lines of the program.
    pub lines: u64,
    /// The file name, from the form's ProgramName and Extension.
    pub file_name: String,
}

/// A part of a program: some of its lines.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Part<'a> {
    /// The text of these blocks.
    pub text: &'a [u8],
    /// Origin of each line, if requested.
    pub trace: &'a [TraceLine],
    /// Number of program lines so far.
    pub lines: u64,
}
