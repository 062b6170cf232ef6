//! Printed programs as files for the editor, and links between a block and its form line.

use std::collections::HashMap;
use std::fs;
use std::path::PathBuf;

use gen_lsp_types as lsp;
use postform::internals::ide::Current;
use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use super::convert::line;
use super::server::Server;
use super::texts::Text;
use super::uri;
use super::view::View;
use crate::config::Config;

/// The folder in which this server writes programs. The folder is deleted when the server ends.
#[derive(Debug, Default)]
pub struct Programs {
    folder: Option<TempDir>,
    /// The form and the job of each file.
    written: HashMap<PathBuf, (lsp::Uri, usize)>,
}

impl Programs {
    /// Writes a program, unless the same file exists.
    fn write(&mut self, form: &lsp::Uri, job: usize, current: &Current) -> Option<PathBuf> {
        if self.folder.is_none() {
            self.folder = tempfile::Builder::new().prefix("postform-").tempdir().ok();
        }
        let stem = uri::path(form).and_then(|path| Some(path.file_stem()?.to_string_lossy().into_owned()));
        let safe =
            |text: &str| text.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect();
        let [job_name, form_name]: [String; 2] = [safe(&current.name), safe(&stem.unwrap_or_default())];
        let path = self.folder.as_ref()?.path().join(format!("{job_name}.{form_name}.nc"));
        if fs::read(&path).ok().as_deref() != Some(current.text().as_bytes()) {
            fs::write(&path, current.text()).ok()?;
        }
        self.written.insert(path.clone(), (form.clone(), job));
        Some(path)
    }
}

/// The URI scheme of programs without a file.
const SCHEME: &str = "postform-program:";

/// The form and the job of a program that this server printed: written to a file, or shown by an extension.
pub fn form_of(server: &Server, text: &Text) -> Option<(lsp::Uri, usize)> {
    if let Some(path) = &text.path {
        return server.programs.borrow().written.get(path).cloned();
    }
    let (name, job) = text.uri.as_ref().strip_prefix(SCHEME)?.split_once('?')?;
    let form = uri::path(&lsp::Uri(format!("file://{}", name.strip_suffix(".nc")?)))?;
    Some((server.texts.of_path(&form)?.uri.clone(), job.parse().ok()?))
}

/// Parameters of `postform/program`.
#[derive(Debug, Deserialize)]
pub struct ProgramParams {
    /// The form.
    uri: lsp::Uri,
    /// The job of the form, counted from 0; the default is the current job.
    #[serde(default)]
    job: Option<usize>,
    /// A text that replaces the open text of the form, such as the committed text.
    #[serde(default)]
    text: Option<String>,
}

/// A program for the editor's extension.
#[derive(Debug, Serialize)]
pub struct ProgramAnswer {
    name: String,
    text: String,
    outcome: String,
}

/// The program of a form that is open.
pub fn program(server: &Server, params: &ProgramParams) -> Option<ProgramAnswer> {
    let view = server.view(&params.uri)?;
    if let Some(text) = &params.text {
        let other = view.with_text(text);
        return answer(other.printed(params.job.unwrap_or(0))?);
    }
    answer(match params.job {
        Some(job) => view.printed(job),
        None => view.current(),
    }?)
}

fn answer(current: &Current) -> Option<ProgramAnswer> {
    Some(ProgramAnswer { name: current.name.clone(), text: current.text().to_owned(), outcome: current.outcome() })
}

/// `postform/jobs`: the files of the jobs that a form prints, the current one first; empty for the built-in job.
pub fn jobs(server: &Server, form: &lsp::Uri) -> Vec<lsp::Uri> {
    server.view(form).map(|view| view.jobs.iter().map(|job| uri::of_path(&job.path)).collect()).unwrap_or_default()
}

/// The URI of the current program of a form.
fn name_of(server: &Server, form: &lsp::Uri, job: usize, current: &Current) -> Option<lsp::Uri> {
    if server.client.virtual_programs {
        let path = uri::path(form)?;
        let encoded = uri::of_path(&path).as_ref().trim_start_matches("file://").to_owned();
        return Some(lsp::Uri(format!("{SCHEME}{encoded}.nc?{job}")));
    }
    Some(uri::of_path(&server.programs.borrow_mut().write(form, job, current)?))
}

/// The number of the current job of a form.
fn current_job(view: &View) -> Option<(usize, &Current)> {
    (0..=view.jobs.len()).find_map(|job| Some((job, view.printed(job)?)))
}

/// Maximum number of blocks in a list of targets: a longer list is of no use.
const MOST_BLOCKS: usize = 200;

/// The blocks that a line of a form printed.
pub fn blocks(server: &Server, form: &lsp::Uri, offset: u32) -> Vec<lsp::Location> {
    let Some(view) = server.view(form) else { return Vec::new() };
    let Some((job, current)) = current_job(&view) else { return Vec::new() };
    let Some(span) = view.document.line_of(view.file, offset) else { return Vec::new() };
    let printed = current.printed(span, MOST_BLOCKS);
    if printed.times == 0 {
        return Vec::new();
    }
    let Some(uri) = name_of(server, form, job, current) else { return Vec::new() };
    let at = |(number, _): &(u64, &str)| lsp::Location { uri: uri.clone(), range: line(*number as u32 - 1) };
    printed.first.iter().map(at).collect()
}

/// The URI of the program for `postform.openProgram`.
pub fn opened(server: &Server, form: &lsp::Uri, job: usize) -> Option<lsp::Uri> {
    let view = server.view(form)?;
    name_of(server, form, job, view.printed(job)?)
}

/// The origin of a block: the form line and the job item.
pub struct Origin {
    /// The line of the form.
    pub form: Option<lsp::Location>,
    /// The item of the job.
    pub item: Option<lsp::Location>,
}

/// The origin of a block of an open program, if a form of its folder prints exactly this program.
pub fn origin(server: &Server, text: &Text, number: u32) -> Option<Origin> {
    let (view, job) = match form_of(server, text) {
        Some((form, job)) => (server.view(&form)?, job),
        None => {
            let path = text.path.as_deref()?;
            let config = Config::near(path).ok()?;
            let view = server.view_of_form(config.form.as_deref()?)?;
            let same =
                |job: &usize| view.printed(*job).is_some_and(|current| same_lines(current.text(), &text.source.text));
            let job = (0..view.jobs.len()).find(same)?;
            (view, job)
        }
    };
    let traced = view.printed(job)?.origin(u64::from(number) + 1)?;
    let form = traced.form.and_then(|span| {
        let source = view.document.files().get(span.file as usize)?;
        Some(lsp::Location { uri: view.uri(span.file, &server.texts)?, range: super::convert::range(source, span) })
    });
    let item = view.jobs.get(job).filter(|_| traced.place.line > 0).map(|text| {
        let at = lsp::Position { line: traced.place.line as u32 - 1, character: traced.place.column.saturating_sub(1) };
        lsp::Location { uri: uri::of_path(&text.path), range: lsp::Range { start: at, end: at } }
    });
    Some(Origin { form, item })
}

/// Whether two programs are equal, apart from their line ends.
fn same_lines(one: &str, other: &str) -> bool {
    one.lines().eq(other.lines())
}
