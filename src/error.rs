//! One error type for every operation of the library.

use std::{error, fmt, io};

use crate::diag::{Code, Diag, Findings};

/// The cause of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The form has errors; nothing can be printed with it.
    Form,
    /// The job is wrong, or requests something that the form can't print.
    Job,
    /// The request is invalid: it has a wrong option, or it reads a job a second time that can be read only once.
    Usage,
    /// The job can't be read; [`std::error::Error::source`] has the reason.
    Input,
    /// The program can't be written; [`std::error::Error::source`] has the reason.
    Output,
    /// The program to verify can't be read; [`std::error::Error::source`] has the reason.
    Program,
    /// The program differs from its job, or a required proof is missing.
    Proof,
    /// A fault of postform itself: please report it.
    Fault,
}

/// The reason why an operation failed, with all findings up to that point: first the warnings, then the error.
///
/// The error is displayed as one line; with `{:#}`, the line of the form is added. [`Error::findings`] has the
/// locations, the help and the fixes.
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

    /// An error for a form with errors. `findings` also contains the form's warnings.
    pub(crate) fn form(findings: Findings) -> Error {
        Error::new(ErrorKind::Form, findings, String::new(), None)
    }

    /// An error for a program that must not run. `findings` are the differences of the program, or its parts that are
    /// not proven.
    pub(crate) fn proof(findings: Findings) -> Error {
        Error::new(ErrorKind::Proof, findings, String::new(), None)
    }

    /// An error for an invalid request. The message names a valid request.
    pub(crate) fn usage(message: impl Into<String>) -> Error {
        Error::new(ErrorKind::Usage, Findings::default(), message.into(), None)
    }

    /// An error that the operating system reports.
    pub(crate) fn of_io(kind: ErrorKind, error: io::Error) -> Error {
        Error::new(kind, Findings::default(), String::new(), Some(error))
    }

    /// Puts warnings of the job before the findings, and adds the text of the form if it is missing.
    pub(crate) fn after(mut self, warnings: Vec<Diag>, files: &[crate::source::Source]) -> Error {
        self.0.findings.diags.splice(0..0, warnings);
        if self.0.findings.files.is_empty() {
            self.0.findings.files = files.to_vec();
        }
        self
    }

    /// The findings, mutable, so that the caller can complete their locations.
    pub(crate) fn diags_mut(&mut self) -> &mut [Diag] {
        &mut self.0.findings.diags
    }

    /// The kind of the failure.
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// The warnings, and the errors that stopped the work. The list is empty if reading or writing failed.
    pub fn findings(&self) -> &Findings {
        &self.0.findings
    }

    /// The input or output error, if that is the cause.
    pub fn io(&self) -> Option<&io::Error> {
        self.0.source.as_ref()
    }

    /// Returns the findings by value.
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

/// An I/O error means that the job can't be read.
impl From<io::Error> for Error {
    fn from(error: io::Error) -> Error {
        Error::of_io(ErrorKind::Input, error)
    }
}

impl fmt::Display for Error {
    /// Writes the first error and the number of further errors. `{:#}` adds the line of the form, with a mark under the
    /// words of the error.
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
    /// Writes all findings, one per line. Rust prints this text when `main` returns the error.
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
