//! What is printed.

use crate::diag::Diag;
use crate::render::TraceLine;
use crate::verify::Verdict;

/// A program, whole.
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

    /// The text of the program, to keep.
    pub fn into_text(self) -> String {
        self.text
    }

    /// Does it do what its job asks for? Never [`Verdict::Different`]: such a program is an error.
    pub fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    /// Warnings and notes of the job and of printing it, each kind once.
    pub fn notes(&self) -> &[Diag] {
        &self.rendered.notes
    }

    /// The same, and what the verdict is about: what differs, or is not proven.
    #[doc(hidden)]
    pub fn findings(&self) -> Vec<Diag> {
        [self.rendered.notes.clone(), self.verdict.diags("the program")].concat()
    }

    /// The name that form and job give its file.
    #[doc(hidden)]
    pub fn file_name(&self) -> &str {
        &self.rendered.file_name
    }

    /// Which form line and which item of the job printed each line; empty unless [`Options::trace`](super::Options::trace)
    /// asked for it.
    pub fn trace(&self) -> &[TraceLine] {
        &self.trace
    }
}

impl AsRef<str> for Program {
    fn as_ref(&self) -> &str {
        &self.text
    }
}

/// What is said of a program that was written elsewhere.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Rendered {
    /// Warnings and notes of the job and of printing it, each kind once.
    pub notes: Vec<Diag>,
    /// Lines of the program.
    pub lines: u64,
    /// What the file of the program is called, by the form's ProgramName and Extension.
    pub file_name: String,
}

/// Some lines of a program, as they come.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Part<'a> {
    /// The text of these blocks.
    pub text: &'a [u8],
    /// Where each came from, if that was asked for.
    pub trace: &'a [TraceLine],
    /// Lines of the program so far.
    pub lines: u64,
}
