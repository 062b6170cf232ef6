//! Findings and errors for Python.

use postform::diag::{Diag, Findings};
use postform::internals::report::{Row, row};
use postform::{ErrorKind, Source};
use pyo3::exceptions::{PyException, PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

pyo3::create_exception!(postform, Error, PyException, "A form, a job or an option that makes no program.");
pyo3::create_exception!(postform, Refused, Error, "A program that does not do what its job asks for.");

/// A finding about a form, a job or a program.
#[pyclass(frozen, module = "postform")]
#[derive(Clone)]
pub struct Finding(Row);

#[pymethods]
impl Finding {
    #[getter]
    fn code(&self) -> &str {
        self.0.code
    }

    #[getter]
    fn severity(&self) -> &str {
        self.0.severity
    }

    #[getter]
    fn message(&self) -> &str {
        &self.0.message
    }

    #[getter]
    fn help(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    #[getter]
    fn file(&self) -> Option<&str> {
        self.0.file.as_deref()
    }

    #[getter]
    fn line(&self) -> Option<u64> {
        self.0.line
    }

    #[getter]
    fn column(&self) -> Option<u32> {
        self.0.column
    }

    #[getter]
    fn path(&self) -> Option<&str> {
        self.0.path.as_deref()
    }

    #[getter]
    fn program_line(&self) -> Option<u64> {
        self.0.program_line
    }

    fn __str__(&self) -> &str {
        &self.0.text
    }

    fn __repr__(&self) -> String {
        format!("<Finding {}>", self.0.text)
    }
}

/// A finding with its position: in a form, or in a job.
pub fn finding(diag: &Diag, files: &[Source]) -> Finding {
    Finding(row(diag, files))
}

/// All findings.
pub fn all(findings: &Findings) -> Vec<Finding> {
    findings.diags.iter().map(|diag| finding(diag, &findings.files)).collect()
}

/// Converts an error of the library to the matching Python exception.
pub fn raised(py: Python<'_>, error: postform::Error) -> PyErr {
    let text = error.to_string();
    match error.kind() {
        ErrorKind::Usage => PyValueError::new_err(text),
        ErrorKind::Input | ErrorKind::Output | ErrorKind::Program => PyOSError::new_err(text),
        ErrorKind::Fault => PyRuntimeError::new_err(text),
        _ => with_findings(py, Error::new_err(text), all(error.findings()), &[]),
    }
}

/// An exception with its findings, and further attributes.
pub fn with_findings(py: Python<'_>, error: PyErr, findings: Vec<Finding>, more: &[(&str, &str)]) -> PyErr {
    let value = error.value(py);
    let set = || {
        value.setattr("findings", findings)?;
        more.iter().try_for_each(|(name, text)| value.setattr(*name, *text))
    };
    match set() {
        Ok(()) => error,
        Err(other) => other,
    }
}
