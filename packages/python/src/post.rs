//! Posts, and the programs that they print.

use std::path::{Path, PathBuf};

use postform::internals::post::shipped;
use postform::internals::sema::MOST_TEXT;
use postform::toolpath::Units;
use postform::{Clock, NoFiles, Options, Source, Verdict};
use pyo3::exceptions::{PyOSError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::findings::{Finding, Refused, all, finding, raised, with_findings};
use crate::jobs::Given;
use crate::spelt;

/// A form that prints programs.
#[pyclass(frozen, module = "postform")]
pub struct Post(postform::Post);

/// A complete program.
#[pyclass(frozen, get_all, module = "postform")]
pub struct Program {
    program: String,
    verdict: String,
    findings: Vec<Finding>,
    file_name: String,
}

#[pymethods]
impl Program {
    fn __str__(&self) -> &str {
        &self.program
    }

    fn __repr__(&self) -> String {
        format!("<Program {}, {}>", self.file_name, self.verdict)
    }
}

/// The keywords of `render` and `render_text`.
#[derive(Default)]
struct Keywords {
    properties: Vec<(String, String)>,
    set: Vec<(String, f64)>,
    program: Option<u32>,
    units: Option<Units>,
    date: Option<String>,
    assume_units: Option<Units>,
    unverified: bool,
}

impl Keywords {
    fn of(given: Option<&Bound<'_, PyDict>>) -> PyResult<Keywords> {
        let mut keywords = Keywords::default();
        for (name, value) in given.into_iter().flatten() {
            let name: String = name.extract()?;
            // a keyword with the value None counts as not given, except `verify`, which needs yes or no
            if value.is_none() && name != "verify" {
                continue;
            }
            match name.as_str() {
                "properties" => {
                    for (name, value) in value.cast::<PyDict>()? {
                        keywords.properties.push((name.extract()?, spelt(&value)?));
                    }
                }
                "set" => {
                    for (name, value) in value.cast::<PyDict>()? {
                        keywords.set.push((name.extract()?, value.extract()?));
                    }
                }
                "program" => keywords.program = Some(value.extract()?),
                "units" => keywords.units = Some(units_of(&value.extract::<String>()?)?),
                "date" => keywords.date = Some(value.extract()?),
                "assume_units" => keywords.assume_units = Some(units_of(&value.extract::<String>()?)?),
                "verify" => keywords.unverified = !value.extract::<bool>()?,
                other => {
                    return Err(PyTypeError::new_err(format!("there is no keyword {other:?} (known: {KEYWORDS})")));
                }
            }
        }
        Ok(keywords)
    }
}

const KEYWORDS: &str = "properties, set, program, units, date, assume_units, verify";

#[pymethods]
impl Post {
    /// A form in a file, with the forms that it calls.
    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Post> {
        compiled(py, source(&path)?, Some(path))
    }

    /// A form as text.
    #[staticmethod]
    #[pyo3(signature = (text, name = "form.pf"))]
    fn from_text(py: Python<'_>, text: &str, name: &str) -> PyResult<Post> {
        compiled(py, Source::from_text(name, text), None)
    }

    /// A post that is shipped with postform, by its name.
    #[staticmethod]
    fn shipped(py: Python<'_>, control: &str) -> PyResult<Post> {
        let found = shipped::FORMS.iter().find(|form| form.name == control || form.also.contains(&control));
        let Some(form) = found else {
            let names: Vec<&str> = shipped::FORMS.iter().map(|form| form.name).collect();
            return Err(PyValueError::new_err(format!("no post {control:?} ships: there are {}", names.join(", "))));
        };
        compiled(py, Source::from_text(format!("{}.pf", form.name), form.text), None)
    }

    /// The control that the form names.
    #[getter]
    fn control(&self) -> Option<&str> {
        self.0.control().map(|control| control.name())
    }

    /// Warnings and notes about the form.
    #[getter]
    fn findings(&self) -> Vec<Finding> {
        all(self.0.findings())
    }

    /// Names of the properties of the form.
    #[getter]
    fn properties(&self) -> Vec<String> {
        self.0.properties().iter().map(|property| property.name.clone()).collect()
    }

    /// Prints a job and verifies the program.
    #[pyo3(signature = (job, **keywords))]
    fn render(
        &self,
        py: Python<'_>,
        job: &Bound<'_, PyAny>,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Program> {
        self.print(py, Given::of(job)?, Keywords::of(keywords)?)
    }

    /// Prints a job that is given as a text, and verifies the program.
    #[pyo3(signature = (text, format, **keywords))]
    fn render_text(
        &self,
        py: Python<'_>,
        text: &str,
        format: &str,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Program> {
        self.print(py, Given::text(text, format)?, Keywords::of(keywords)?)
    }

    /// The verdict about a program.
    #[pyo3(signature = (job, program, *, assume_units=None))]
    fn verify(
        &self,
        py: Python<'_>,
        job: &Bound<'_, PyAny>,
        program: &str,
        assume_units: Option<String>,
    ) -> PyResult<String> {
        let given = Given::of(job)?;
        let assumed = assume_units.as_deref().map(units_of).transpose()?;
        let verdict = py.detach(|| {
            let mut job = given.job()?;
            job.reading.units = assumed;
            Ok::<_, PyErr>(self.0.verify(job, program))
        })?;
        verdict.map(|verdict| verdict.to_string()).map_err(|error| raised(py, error))
    }

    fn __repr__(&self) -> String {
        format!("<Post {}>", self.0.files().first().map_or("", |source| &source.name))
    }
}

impl Post {
    fn print(&self, py: Python<'_>, given: Given, keywords: Keywords) -> PyResult<Program> {
        let mut options = Options::default();
        options.proof = options.proof.filter(|_| !keywords.unverified);
        options.program = keywords.program;
        options.units = keywords.units;
        options.job_file = given.file_name();
        options.properties = keywords.properties;
        for (name, value) in keywords.set {
            options.set_value(&name, value).map_err(|error| raised(py, error))?;
        }
        let date = match keywords.date {
            None if self.0.says_time() => Some(now(py)?),
            date => date,
        };
        options.clock = date.as_deref().map(clock).transpose()?;
        let tried = py.detach(|| {
            let mut job = given.job()?;
            job.reading.units = keywords.assume_units;
            Ok::<_, PyErr>(self.0.tried(job, &options))
        })?;
        let tried = tried.map_err(|error| raised(py, error))?;
        let findings: Vec<Finding> = tried.findings().iter().map(|diag| finding(diag, self.0.files())).collect();
        let verdict = tried.verdict().to_string();
        if matches!(tried.verdict(), Verdict::Different(_)) {
            let more = [("program", tried.text()), ("verdict", verdict.as_str())];
            return Err(with_findings(py, Refused::new_err(verdict.clone()), findings, &more));
        }
        Ok(Program { verdict, findings, file_name: tried.file_name().to_owned(), program: tried.into_text() })
    }
}

/// Every finding of a form.
#[pyfunction]
pub fn lint(path: PathBuf) -> PyResult<Vec<Finding>> {
    match post_of(source(&path)?, Some(path)) {
        Ok(post) => Ok(all(post.findings())),
        Err(error) => Ok(all(error.findings())),
    }
}

fn compiled(py: Python<'_>, form: Source, path: Option<PathBuf>) -> PyResult<Post> {
    py.detach(|| post_of(form, path)).map(Post).map_err(|error| raised(py, error))
}

fn post_of(form: Source, path: Option<PathBuf>) -> Result<postform::Post, postform::Error> {
    let Some(path) = path else { return postform::Post::compile(form, &NoFiles) };
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    postform::Post::compile(form, &|name: &str| {
        let base = if folder.as_os_str().is_empty() { Path::new(".") } else { folder.as_path() };
        let (Ok(real), Ok(root)) = (base.join(name).canonicalize(), base.canonicalize()) else {
            return Err("can't be found".to_owned());
        };
        // called forms must be in the folder of the form or below it, also after links are followed
        if !real.starts_with(root) {
            return Err("is outside the form's folder".to_owned());
        }
        source(&folder.join(name)).map_err(|_| "can't be read".to_owned())
    })
}

fn source(path: &Path) -> PyResult<Source> {
    let fail = |error: std::io::Error| PyOSError::new_err(format!("can't read {}: {error}", path.display()));
    if std::fs::metadata(path).map_err(fail)?.len() > MOST_TEXT as u64 {
        let message = format!("{} is larger than {} KB: it is no form", path.display(), MOST_TEXT >> 10);
        return Err(PyValueError::new_err(message));
    }
    Ok(Source::from_bytes(path.to_string_lossy(), &std::fs::read(path).map_err(fail)?))
}

fn units_of(name: &str) -> PyResult<Units> {
    match name {
        "mm" => Ok(Units::Mm),
        "inch" => Ok(Units::Inch),
        other => Err(PyValueError::new_err(format!("units are \"mm\" or \"inch\", not {other:?}"))),
    }
}

/// The moment, as `2026-03-31T14:05`.
fn now(py: Python<'_>) -> PyResult<String> {
    let now = py.import("datetime")?.getattr("datetime")?.call_method0("now")?;
    now.call_method1("isoformat", ("T", "minutes"))?.extract()
}

/// A day, or a day and a time.
fn clock(text: &str) -> PyResult<Clock> {
    let wrong = || format!("date={text:?}: write a day, as 2026-03-31, or 2026-03-31T14:05");
    Clock::parse(text).ok_or_else(|| PyValueError::new_err(wrong()))
}
