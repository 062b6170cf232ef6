//! Functions that the tests share: rendering with the library, without the command line.

pub mod editor;
pub mod folder;
pub mod nc;
pub mod pages;

use std::fs;
use std::path::{Path, PathBuf};

use postform::diag::Diag;
use postform::internals::cl::read_cl;
use postform::internals::compile::{Program, compile};
use postform::internals::control::Control;
use postform::internals::json::{read_document, read_lines};
use postform::internals::nc::{JobOptions, RunSettings};
use postform::internals::post::taken;
use postform::internals::render::{Options, Renderer, TraceLine, survey_terms};
use postform::internals::sema::{Checked, Limits, analyse, one_post};
use postform::internals::source::Source;
use postform::internals::survey::Surveyor;
use postform::toolpath::{Flow, ReadError, Sink, Stop};

/// A built-in control; for an unknown name, the default control.
pub fn control(name: &str) -> &'static Control {
    Control::named(name).unwrap_or_else(Control::usual)
}

/// Options for a program that is read as a job, without values that the program lacks.
pub fn job_options(settings: RunSettings) -> JobOptions<'static> {
    JobOptions { settings, units: None, tool: None, tool_names: &[], start: None }
}

/// The folder of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().to_path_buf()
}

/// Checks a form from text; it calls no other form.
pub fn check(text: &str) -> Checked {
    analyse(Source::from_text("form.pf", text), Limits::Classic, &mut |_| Err("can't be found".into()))
}

/// Checks a form from a file. A form that it calls is in the same folder.
pub fn check_file(path: &Path) -> Checked {
    let folder = path.parent().unwrap().to_path_buf();
    let mut form = Source::from_bytes(path.to_string_lossy(), &fs::read(path).unwrap());
    // if a file contains several posts, the sample's folder selects one
    if let Some(post) = tests_of(&folder).1 {
        form = one_post(form, post.as_str()).unwrap_or_else(|names| panic!("{names:?}"));
    }
    analyse(form, Limits::Classic, &mut |name| {
        fs::read(folder.join(name)).map(|bytes| Source::from_bytes(name, &bytes)).map_err(|e| e.to_string())
    })
}

/// A shipped form by its file in postforms/, without the comments of its header. For tests of motions.
pub fn plain_post(file: &str) -> String {
    without_header(&fs::read_to_string(root().join("postforms").join(file)).unwrap())
}

/// The form without the property `header`, and without the lines under `@if [header]`.
pub fn without_header(form: &str) -> String {
    let mut kept = String::new();
    // the nesting depth of directives in `@if [header]`, and whether its `@else` was reached
    let (mut depth, mut in_else) = (0, false);
    for line in form.lines() {
        let begins = line.trim_start();
        match depth {
            0 if begins.starts_with("@if [header]") => (depth, in_else) = (1, false),
            0 if begins.starts_with("Property header ") => {}
            0 => kept += &format!("{line}\n"),
            1 if begins == "@else" => in_else = true,
            _ => {
                depth += usize::from(begins.starts_with("@if") || begins.starts_with("@for"));
                depth -= usize::from(begins == "@end");
                if depth > 0 && in_else {
                    kept += &format!("{begins}\n");
                }
            }
        }
    }
    assert!(!kept.contains("[header]"), "{kept}");
    kept.replace("Operation\nEnd\n", "")
}

/// The error with which a sink refuses an event.
pub fn wrong(flow: Flow) -> Box<Diag> {
    match flow {
        Flow::Break(Stop::Wrong(diag)) => diag,
        other => panic!("{other:?}"),
    }
}

/// The result of printing a job.
#[derive(Debug)]
pub struct Rendered {
    pub text: String,
    pub trace: Vec<TraceLine>,
    pub notes: Vec<Diag>,
}

pub fn render_checked(checked: &Checked, job: &[u8], lines: bool, options: Options) -> Result<Rendered, Box<Diag>> {
    render_kind(checked, job, if lines { Kind::Lines } else { Kind::Document }, options)
}

pub fn render_kind(checked: &Checked, job: &[u8], kind: Kind, options: Options) -> Result<Rendered, Box<Diag>> {
    render_ready(&ready(checked)?, job, kind, options)
}

/// Compiles a form without errors, so that it can print many jobs.
pub fn ready(checked: &Checked) -> Result<Program, Box<Diag>> {
    match checked.diags.iter().find(|diag| diag.is_error()) {
        Some(error) => Err(Box::new(error.clone())),
        None => Ok(compile(&checked.form).identified(&checked.files)),
    }
}

pub fn render_ready(program: &Program, job: &[u8], kind: Kind, options: Options) -> Result<Rendered, Box<Diag>> {
    let from = |sink: &mut dyn Sink| match kind {
        Kind::Lines => read_lines(job, sink),
        Kind::Document => read_document(job, sink),
        Kind::Cl => read_cl(
            job,
            &postform::internals::cl::Options::default(),
            &mut postform::internals::cl::Report::default(),
            sink,
        ),
    };
    let read = |sink: &mut dyn Sink| taken(Some(&program.settings), sink, from);
    let mut survey = None;
    let asks = program.asks_ahead(&options.properties);
    if asks.all || asks.tools {
        let mut surveyor = Surveyor::new(survey_terms(program, false, !asks.all, None));
        if let Err(ReadError::Job(diag)) = read(&mut surveyor) {
            return Err(diag);
        }
        survey = Some(surveyor.finish().into());
    }
    let mut renderer = Renderer::new(program, Options { trace: true, survey, ..options });
    match read(&mut renderer) {
        Ok(()) => Ok(Rendered {
            text: String::from_utf8(std::mem::take(renderer.text())).unwrap(),
            trace: std::mem::take(renderer.trace().unwrap()),
            notes: renderer.notes().to_vec(),
        }),
        Err(ReadError::Job(diag)) => Err(diag),
        Err(other) => panic!("{other:?}"),
    }
}

pub fn render(form: &str, job: &str) -> Result<Rendered, Box<Diag>> {
    render_checked(&check(form), job.as_bytes(), false, Options::default())
}

/// The lines that a job prints, or the error's code and message.
pub fn program(form: &str, job: &str) -> Vec<String> {
    match render(form, job) {
        Ok(rendered) => rendered.text.lines().map(str::to_owned).collect(),
        Err(diag) => vec![format!("{} {}", diag.code.name(), diag.message)],
    }
}

/// A complete small form for a mill, with these lines in its head and these sequences at its end.
pub fn mill(head: &str, sequences: &str) -> String {
    format!(
        "{head}\nStartCode\n%0\nEnd\n1stToolChange\nT[tool] M6\nS[speed] M[direct]\nG0 G[work] X[h] Y[v] Z[d]\nEnd\n\
         ToolChange\nT[tool] M6\nS[speed] M[direct]\nG0 G[work] X[h] Y[v] Z[d]\nEnd\nCancel\nG80\nEnd\nEndCode\nM30\nEnd\n{sequences}\n"
    )
}

/// A job with one tool, a first rapid to 0 0 1, and these path items.
pub fn job(path: &str) -> String {
    format!(
        "{{\"postform\":1,\"program\":100,\"units\":\"inch\",\"tools\":[{{\"number\":1,\"diameter_offset\":21}},{{\"number\":2}}],\
         \"operations\":[{{\"tool\":1,\"work\":54,\"spindle\":{{\"speed\":1000,\"direction\":\"cw\"}},\"feed\":10,\
         \"path\":[{{\"rapid\":[0,0,1]}},{path}]}}]}}"
    )
}

/// The program of `mill` and `job`, without the blocks before and after the path.
pub fn path_lines(head: &str, sequences: &str, path: &str) -> Vec<String> {
    let lines = program(&mill(head, sequences), &job(path));
    if lines.len() == 1 {
        return lines;
    }
    lines[4..lines.len() - 1].to_vec()
}

/// The folders of all samples.
pub fn samples() -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join("samples")).unwrap().map(|e| e.unwrap().path());
    let mut folders: Vec<_> = entries.filter(|path| path.is_dir()).collect();
    folders.sort();
    assert!(folders.len() >= 12, "at least 12 samples");
    folders
}

/// The form of a sample: its own, or a post that it names.
pub fn sample_form(folder: &Path) -> Option<PathBuf> {
    let own = folder.join("form.pf");
    if own.exists() {
        return Some(own);
    }
    tests_of(folder).0.first().map(|form| folder.join(form))
}

/// The settings under [test] in a sample's own postform.toml: forms, and a post.
fn tests_of(folder: &Path) -> (Vec<String>, Option<String>) {
    let Ok(text) = fs::read_to_string(folder.join("postform.toml")) else { return Default::default() };
    let test = postform::Config::parse(&text).unwrap().test;
    (test.forms, test.post)
}

/// The formats of jobs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Document,
    Lines,
    Cl,
}

/// The job of a sample, and its format.
pub fn sample_job(folder: &Path) -> (PathBuf, Kind) {
    let kinds = [("job.jsonl", Kind::Lines), ("job.cl", Kind::Cl), ("job.json", Kind::Document)];
    let found = kinds.map(|(name, kind)| (folder.join(name), kind)).into_iter().find(|(path, _)| path.exists());
    found.unwrap_or_else(|| panic!("{} has no job", folder.display()))
}

/// Renders a sample with a form.
pub fn render_sample(folder: &Path, form: &Path) -> Result<Rendered, Box<Diag>> {
    render_sample_with(folder, form, Options::default())
}

pub fn render_sample_with(folder: &Path, form: &Path, options: Options) -> Result<Rendered, Box<Diag>> {
    render_ready_sample(folder, &ready(&check_file(form)), options)
}

/// Renders a sample with a compiled form, or returns the form's error.
pub fn render_ready_sample(
    folder: &Path,
    form: &Result<Program, Box<Diag>>,
    options: Options,
) -> Result<Rendered, Box<Diag>> {
    let (job, kind) = sample_job(folder);
    render_ready(form.as_ref().map_err(Clone::clone)?, &fs::read(job).unwrap(), kind, options)
}

/// Panics with the lines that differ.
pub fn assert_same(what: &str, expected: &str, found: &str) {
    if expected != found {
        let diff = similar::TextDiff::from_lines(expected, found);
        panic!("{what} differs:\n{}", diff.unified_diff().header("expected", "found"));
    }
}
