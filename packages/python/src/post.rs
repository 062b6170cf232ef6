//! Posts and what they print.

use std::io::Cursor;
use std::path::{Component, Path, PathBuf};

use postform::internals::post::shipped;
use postform::internals::render::Clock;
use postform::toolpath::Units;
use postform::{NoFiles, Options, Proof, Source, Verdict};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::findings::{Finding, Refused, all, finding, raised, with_findings};
use crate::jobs::Given;
use crate::spelt;

/// Largest form, in bytes: a longer file is none.
const LARGEST_FORM: u64 = 1 << 20;

/// A form that prints programs.
#[pyclass(frozen, module = "postform")]
pub struct Post(postform::Post);

/// A program, whole.
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

/// How a job is printed.
struct Asked {
    given: Given,
    options: Options,
    units: Option<Units>,
    verify: bool,
}

/// The keywords of `render` and `render_text`.
struct Keywords<'py> {
    properties: Option<Bound<'py, PyDict>>,
    set: Option<Bound<'py, PyDict>>,
    program: Option<u32>,
    units: Option<String>,
    date: Option<String>,
    assume_units: Option<String>,
    verify: bool,
}

#[pymethods]
impl Post {
    /// A form in a file, with those that it calls.
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

    /// A post that ships, by its name.
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

    /// Names of its properties.
    #[getter]
    fn properties(&self) -> Vec<String> {
        self.0.properties().iter().map(|property| property.name.clone()).collect()
    }

    /// Prints a job and verifies the program.
    #[pyo3(signature = (job, *, properties=None, set=None, program=None, units=None, date=None, assume_units=None, verify=true))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn render(
        &self,
        py: Python<'_>,
        job: &Bound<'_, PyAny>,
        properties: Option<Bound<'_, PyDict>>,
        set: Option<Bound<'_, PyDict>>,
        program: Option<u32>,
        units: Option<String>,
        date: Option<String>,
        assume_units: Option<String>,
        verify: bool,
    ) -> PyResult<Program> {
        let keywords = Keywords { properties, set, program, units, date, assume_units, verify };
        self.print(py, self.asked(py, Given::of(job)?, keywords)?)
    }

    /// The same for the text of a job.
    #[pyo3(signature = (text, format, *, properties=None, set=None, program=None, units=None, date=None, assume_units=None, verify=true))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn render_text(
        &self,
        py: Python<'_>,
        text: &str,
        format: &str,
        properties: Option<Bound<'_, PyDict>>,
        set: Option<Bound<'_, PyDict>>,
        program: Option<u32>,
        units: Option<String>,
        date: Option<String>,
        assume_units: Option<String>,
        verify: bool,
    ) -> PyResult<Program> {
        let keywords = Keywords { properties, set, program, units, date, assume_units, verify };
        self.print(py, self.asked(py, Given::text(text, format)?, keywords)?)
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
    fn asked(&self, py: Python<'_>, given: Given, keywords: Keywords<'_>) -> PyResult<Asked> {
        let mut options = Options::default();
        options.proof = None;
        options.program = keywords.program;
        options.units = keywords.units.as_deref().map(units_of).transpose()?;
        options.job_file = given.file_name();
        for (name, value) in keywords.properties.iter().flatten() {
            options.properties.push((name.extract()?, spelt(&value)?));
        }
        for (name, value) in keywords.set.iter().flatten() {
            let name: String = name.extract()?;
            options.set_value(&name, value.extract()?).map_err(|error| raised(py, error))?;
        }
        let date = match keywords.date {
            None if self.0.says_time() => Some(now(py)?),
            date => date,
        };
        options.clock = date.map(|date| clock(py, &date)).transpose()?;
        let units = keywords.assume_units.as_deref().map(units_of).transpose()?;
        Ok(Asked { given, options, units, verify: keywords.verify })
    }

    fn print(&self, py: Python<'_>, asked: Asked) -> PyResult<Program> {
        let job = || {
            let mut job = asked.given.job()?;
            job.reading.units = asked.units;
            Ok::<_, PyErr>(job)
        };
        let done = py.detach(|| {
            let mut text = Vec::new();
            let rendered = match self.0.render_to(job()?, &asked.options, &mut text) {
                Ok(rendered) => rendered,
                Err(error) => return Ok(Err(error)),
            };
            let proven = match asked.verify {
                true => Some(self.0.verify_with(job()?, Cursor::new(&text), &asked.options, &Proof::default())),
                false => None,
            };
            Ok::<_, PyErr>(Ok((text, rendered, proven.transpose())))
        })?;
        let (text, rendered, proven) = done.map_err(|error| raised(py, error))?;
        let program = String::from_utf8_lossy(&text).into_owned();
        let files = self.0.files();
        let mut findings: Vec<Finding> = rendered.notes.iter().map(|diag| finding(diag, files)).collect();
        let verdict = match proven.map_err(|error| raised(py, error))? {
            None => "not verified".to_owned(),
            Some(proven) => {
                let found = match &proven.verdict {
                    Verdict::Different(found) => found.as_slice(),
                    Verdict::NotProven(unproven) => &unproven.notes,
                    _ => &[],
                };
                findings.extend(found.iter().map(|found| finding(&found.diag("the program"), files)));
                let verdict = proven.verdict.to_string();
                if matches!(proven.verdict, Verdict::Different(_)) {
                    let error = Refused::new_err(verdict.clone());
                    let more = [("program", program.as_str()), ("verdict", verdict.as_str())];
                    return Err(with_findings(py, error, findings, &more));
                }
                verdict
            }
        };
        Ok(Program { program, verdict, findings, file_name: rendered.file_name })
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
        // the folder of the form and those below it
        if !Path::new(name).components().all(|part| matches!(part, Component::Normal(_))) {
            return Err("is outside the form's folder".to_owned());
        }
        source(&folder.join(name)).map_err(|_| "can't be read".to_owned())
    })
}

fn source(path: &Path) -> PyResult<Source> {
    let fail = |error: std::io::Error| PyOSError::new_err(format!("can't read {}: {error}", path.display()));
    if std::fs::metadata(path).map_err(fail)?.len() > LARGEST_FORM {
        return Err(PyValueError::new_err(format!("{} is larger than 1 MB: it is no form", path.display())));
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
fn clock(py: Python<'_>, text: &str) -> PyResult<Clock> {
    let read = py.import("datetime")?.getattr("datetime")?.call_method1("fromisoformat", (text,));
    if read.is_err() {
        return Err(PyValueError::new_err(format!("date={text:?}: write a day, as 2026-03-31, or 2026-03-31T14:05")));
    }
    let (date, time) = text.split_at_checked(10).unwrap_or((text, ""));
    let time = time.get(1..6).unwrap_or_default();
    Ok(Clock { date: date.to_owned(), time: time.to_owned() })
}
