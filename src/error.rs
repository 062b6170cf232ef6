//! Why something was not done: one error for everything that the library is asked.

use std::{error, fmt, io};

use crate::diag::{Code, Diag, Findings};

/// What an error is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The form has errors; nothing can be printed with it.
    Form,
    /// The job is wrong, or asks for what the form can't print.
    Job,
    /// What was asked for makes no sense: an option, or a job that can't be read twice.
    Usage,
    /// The job can't be read; [`std::error::Error::source`] says why.
    Input,
    /// The program can't be written; [`std::error::Error::source`] says why.
    Output,
    /// The program that is to be verified can't be read; [`std::error::Error::source`] says why.
    Program,
    /// The program does something else than its job asks for, or a proof was required and there is none.
    Proof,
    /// A fault of postform itself: please report it.
    Fault,
}

/// Why something was not done, with all that was found until then: the warnings first, then what stopped it.
///
/// It shows as one line, with `{:#}` and the line of the form below it; [`Error::findings`] has the places, the help and the fixes.
pub struct Error(Box<Inner>);

struct Inner {
    kind: ErrorKind,
    findings: Findings,
    message: String,
    source: Option<io::Error>,
}

impl Error {
    fn new(kind: ErrorKind, findings: Findings, message: String, source: Option<io::Error>) -> Error {
        Error(Box::new(Inner { kind, findings, message, source }))
    }

    /// The error of a form with these errors, and its warnings.
    pub(crate) fn form(findings: Findings) -> Error {
        Error::new(ErrorKind::Form, findings, String::new(), None)
    }

    /// A program that must not run, and why: what differs, or what is not proven.
    pub(crate) fn proof(findings: Findings) -> Error {
        Error::new(ErrorKind::Proof, findings, String::new(), None)
    }

    /// What was asked for makes no sense, and what to ask instead.
    pub(crate) fn usage(message: impl Into<String>) -> Error {
        Error::new(ErrorKind::Usage, Findings::default(), message.into(), None)
    }

    /// The system says no to this.
    pub(crate) fn of_io(kind: ErrorKind, error: io::Error) -> Error {
        Error::new(kind, Findings::default(), String::new(), Some(error))
    }

    /// The error with what was found before it: warnings of a job, and the text of its form.
    pub(crate) fn after(mut self, warnings: Vec<Diag>, files: &[crate::source::Source]) -> Error {
        self.0.findings.diags.splice(0..0, warnings);
        if self.0.findings.files.is_empty() {
            self.0.findings.files = files.to_vec();
        }
        self
    }

    /// The findings, to complete their places.
    pub(crate) fn diags_mut(&mut self) -> &mut [Diag] {
        &mut self.0.findings.diags
    }

    /// What kind of failure this is.
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// Warnings, and the errors that stopped the work. Empty where input or output failed.
    pub fn findings(&self) -> &Findings {
        &self.0.findings
    }

    /// The failure of the input or the output, where that is the error.
    pub fn io(&self) -> Option<&io::Error> {
        self.0.source.as_ref()
    }

    /// The findings, to keep.
    pub fn into_findings(self) -> Findings {
        self.0.findings
    }
}

impl From<Box<Diag>> for Error {
    fn from(diag: Box<Diag>) -> Error {
        let kind = if diag.code == Code::PX001 { ErrorKind::Fault } else { ErrorKind::Job };
        let findings = Findings { diags: vec![*diag], ..Findings::default() };
        Error::new(kind, findings, String::new(), None)
    }
}

/// The job can't be read.
impl From<io::Error> for Error {
    fn from(error: io::Error) -> Error {
        Error::of_io(ErrorKind::Input, error)
    }
}

impl fmt::Display for Error {
    /// The first error, and how many more there are. `{:#}` adds the line of the form that it is about, with a mark under the
    /// words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Inner { findings, message, source, .. } = &*self.0;
        let mut errors = findings.diags.iter().filter(|diag| diag.is_error());
        match (errors.next(), source) {
            (Some(first), _) => f.write_str(&first.line(&findings.files))?,
            (None, Some(source)) => write!(f, "{source}")?,
            (None, None) => f.write_str(message)?,
        }
        let first = findings.diags.iter().find(|diag| diag.is_error());
        match errors.count() {
            0 => {}
            1 => f.write_str(" (and 1 more error)")?,
            more => write!(f, " (and {more} more errors)")?,
        }
        match first.and_then(|first| first.marked(&findings.files)).filter(|_| f.alternate()) {
            Some(marked) => write!(f, "\n{marked}"),
            None => Ok(()),
        }
    }
}

impl fmt::Debug for Error {
    /// All findings, a line each: what a `main` that returns it shows.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.findings.is_empty() {
            true => write!(f, "{self}"),
            false => write!(f, "{}", self.0.findings),
        }
    }
}

impl error::Error for Error {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        self.0.source.as_ref().map(|source| source as _)
    }
}
