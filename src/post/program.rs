//! Printed programs, and the results of printing.

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

    /// Returns the text of the program without copying it.
    pub fn into_text(self) -> String {
        self.text
    }

    /// The verdict on the program. The verdict is never [`Verdict::Different`], because a program with other motions is
    /// returned as an error.
    pub fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    /// Warnings and notes about the job and about printing it. Each kind of warning or note occurs only once.
    pub fn notes(&self) -> &[Diag] {
        &self.rendered.notes
    }

    /// The notes and the findings of the verdict. The findings of the verdict are differences, or parts that are not
    /// proven.
    #[doc(hidden)]
    pub fn findings(&self) -> Vec<Diag> {
        [self.rendered.notes.clone(), self.verdict.diags("the program")].concat()
    }

    /// The file name of the program, from the form and the job.
    #[doc(hidden)]
    pub fn file_name(&self) -> &str {
        &self.rendered.file_name
    }

    /// For each line, the form line and the job item that printed it. The list is empty if
    /// [`Options::trace`](super::Options::trace) is not set.
    pub fn trace(&self) -> &[TraceLine] {
        &self.trace
    }
}

impl AsRef<str> for Program {
    fn as_ref(&self) -> &str {
        &self.text
    }
}

/// The result of printing a program to an output.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Rendered {
    /// Warnings and notes about the job and about printing it. Each kind of warning or note occurs only once.
    pub notes: Vec<Diag>,
    /// Number of operations of the job that are not in the program, because they are not selected.
    pub left_out: u64,
    /// Number of lines in the program.
    pub lines: u64,
    /// The file name, which the form determines by ProgramName and Extension.
    pub file_name: String,
}

/// A part of a program, which consists of some of its lines.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Part<'a> {
    /// The text of the part.
    pub text: &'a [u8],
    /// The origin of each line in the part, if requested.
    pub trace: &'a [TraceLine],
    /// Number of program lines up to the end of the part.
    pub lines: u64,
}
