//! Jobs from Python: a path, a dictionary, or an iterable of items.

use std::ffi::OsStr;
use std::fs::File;
use std::path::{Path, PathBuf};

use postform::{Format, Job};
use pyo3::exceptions::{PyOSError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PyString};

/// A job that can be read again.
pub enum Given {
    /// A file.
    File(PathBuf, Format),
    /// A text.
    Text(Vec<u8>, Format),
}

impl Given {
    /// Converts the job that the caller passes.
    pub fn of(job: &Bound<'_, PyAny>) -> PyResult<Given> {
        let py = job.py();
        let path = if job.is_instance_of::<PyString>() || job.hasattr("__fspath__")? {
            Some(job.extract::<PathBuf>()?)
        } else {
            None
        };
        if let Some(path) = path {
            let format = format_of(&path)?;
            return Ok(Given::File(path, format));
        }
        let dumps = py.import("json")?.getattr("dumps")?;
        // NaN and infinity are not allowed in JSON or in positions
        let options = PyDict::new(py);
        options.set_item("allow_nan", false)?;
        let text = |value: &Bound<'_, PyAny>| dumps.call((value,), Some(&options))?.extract::<String>();
        if job.cast::<PyMapping>().is_ok() {
            return Ok(Given::Text(text(job)?.into_bytes(), Format::Json));
        }
        let Ok(items) = job.try_iter() else {
            return Err(PyTypeError::new_err("a job is a path, a mapping, or an iterable of its items"));
        };
        let mut lines = Vec::new();
        for item in items {
            lines.extend_from_slice(text(&item?)?.as_bytes());
            lines.push(b'\n');
        }
        Ok(Given::Text(lines, Format::JsonLines))
    }

    /// A text in a format by its name.
    pub fn text(text: &str, format: &str) -> PyResult<Given> {
        let format = match Format::parse(format) {
            Some(Format::Freecad) => {
                return Err(PyValueError::new_err("a FreeCAD document is not a text: give its path to render"));
            }
            Some(format) => format,
            None => {
                let known = "json, jsonl, cl, nc, nci";
                return Err(PyValueError::new_err(format!("there is no format {format:?}: use one of {known}")));
            }
        };
        Ok(Given::Text(text.as_bytes().to_vec(), format))
    }

    /// The job, to be read from its beginning.
    pub fn job(&self) -> PyResult<Job<'_>> {
        Ok(match self {
            Given::File(path, format) => Job::file(*format, opened(path)?).named(&path.to_string_lossy()),
            Given::Text(text, format) => Job::bytes(*format, text),
        })
    }

    /// The name of the file, for forms that print it.
    pub fn file_name(&self) -> Option<String> {
        match self {
            Given::File(path, _) => path.file_name().map(OsStr::to_string_lossy).map(Into::into),
            Given::Text(..) => None,
        }
    }
}

fn opened(path: &Path) -> PyResult<File> {
    File::open(path).map_err(|error| PyOSError::new_err(format!("can't read {}: {error}", path.display())))
}

fn format_of(path: &Path) -> PyResult<Format> {
    use std::io::Read as _;
    if let Some(format) = Format::of_name(&path.to_string_lossy()) {
        return Ok(format);
    }
    let mut head = vec![0; Format::LOOKED_AT];
    let read = opened(path)?.read(&mut head)?;
    let unknown = || {
        let name = path.display();
        PyValueError::new_err(format!(
            "can't tell what {name} is, by its name or how it begins: give its text to render_text"
        ))
    };
    Format::of_content(&head[..read]).ok_or_else(unknown)
}
