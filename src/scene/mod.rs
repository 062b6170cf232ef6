//! Everything that the page shows of a form and a job, as one run of bytes.
//!
//! A [`Scene`] is a JSON head and named sections of numbers behind it: what is long (points, blocks, their places) is not JSON, so that
//! a program of a million moves is there at once. `page/src/scene.ts` reads it; the same bytes come from `postform watch`, stand in
//! a page of `postform plot`, and are made in the browser by the playground.

mod compare;
mod form;
mod pack;
mod program;
mod verdict;

pub use pack::Scene;

use std::io::Cursor;

use serde_json::{Value, json};

use crate::diag::{Diag, escaped};
use crate::diff::{self, Deadline};
use crate::error::{Error, ErrorKind};
use crate::job::Job;
use crate::lint::{Levels, lint};
use crate::nc::RunSettings;
use crate::picture::{Picture, draw};
use crate::post::{Files, Options, Post, Program, Proof};
use crate::sema::{Limits, analyse};
use crate::source::Source;
use crate::toolpath::Units;

/// What is shown.
pub struct Request<'a> {
    /// The form.
    pub form: Source,
    /// The forms that it calls.
    pub files: &'a dyn Files,
    /// Limits of the form.
    pub limits: Limits,
    /// What rules count as.
    pub levels: &'a Levels,
    /// The job, and its name.
    pub job: Job<'a>,
    /// What the job is called.
    pub job_name: &'a str,
    /// How the job is printed.
    pub options: Options,
    /// How the program is run.
    pub proof: Proof,
    /// Another program of the job, with its name: it is shown under the new one.
    pub against: Option<(&'a str, &'a [u8])>,
    /// The form as it was saved and those that it calls, where they are others: its program is compared with the new one.
    pub saved: Option<(Source, &'a dyn Files)>,
    /// Is the program proven, too?
    pub proves: bool,
    /// How long programs are compared for the shortest answer; without it as long as it takes.
    pub deadline: Option<Deadline>,
}

/// A form, what it prints for a job, what that does, and whether it is what the job asks for.
///
/// What is wrong is in the scene: a form with errors has findings and no program.
pub fn scene(mut request: Request<'_>) -> Scene {
    let checked = analyse(request.form.clone(), request.limits, &mut |name| request.files.read(name));
    let found = lint(&checked, request.levels);
    let mut scene = Scene::new();
    scene.say("form", form::form(&checked.files, &found.diags, found.suppressed));
    scene.say("job", json!({ "name": escaped(request.job_name) }));
    match made(&mut request) {
        Ok(made) => show(&mut scene, &mut request, &made),
        Err(Wrong { what, message, diags, files }) => {
            let errors: Vec<Value> = diags.iter().map(|diag| form::finding(diag, &files)).collect();
            scene.say("stopped", json!({ "by": what, "message": message, "findings": errors }));
        }
    }
    scene
}

/// A program that is there, and what it does.
pub fn of_program(name: &str, text: &[u8], picture: &Picture) -> Scene {
    let mut scene = Scene::new();
    scene.say("job", json!({ "name": escaped(name) }));
    program::text(&mut scene, "", text);
    program::picture(&mut scene, "", picture);
    scene
}

/// What a form makes of a job.
struct Made {
    post: Post,
    program: Program,
    settings: RunSettings,
    picture: Picture,
}

/// Why there is no program.
struct Wrong {
    /// `form`, `job` or `input`.
    what: &'static str,
    /// All of it in a line.
    message: String,
    diags: Vec<Diag>,
    files: Vec<Source>,
}

impl From<Error> for Wrong {
    fn from(error: Error) -> Wrong {
        let what = match error.kind() {
            ErrorKind::Form => "form",
            ErrorKind::Job | ErrorKind::Fault => "job",
            _ => "input",
        };
        let message = error.to_string();
        let findings = error.into_findings();
        let mut diags = findings.diags;
        diags.retain(Diag::is_error);
        Wrong { what, message, diags, files: findings.files }
    }
}

fn made(request: &mut Request<'_>) -> Result<Made, Wrong> {
    let post = Post::compile_with(request.form.clone(), request.files, request.limits, request.levels)?;
    let options = answered(&post, &request.options);
    let program = post.render(request.job.again(), &options).map_err(|error| {
        let mut wrong = Wrong::from(error);
        wrong.files = post.files().to_vec();
        wrong
    })?;
    let units = match options.units {
        Some(units) => units,
        None => request.job.units()?.unwrap_or(Units::Mm),
    };
    let settings = post.run_settings(&request.proof, units);
    let picture = draw(Cursor::new(program.text()), settings).map_err(Error::from)?;
    Ok(Made { post, program, settings, picture })
}

/// With the source map, and with an answer to each question that nobody answered.
fn answered(post: &Post, options: &Options) -> Options {
    // the scene shows a program that is different, too, and proves it by itself
    let mut options = Options { trace: true, proof: None, ..options.clone() };
    for prompt in post.prompts() {
        if !options.set.iter().any(|(name, _)| name == prompt.variable) {
            options.set.push((prompt.variable.to_owned(), prompt.default.unwrap_or(0.0)));
        }
    }
    options
}

fn show(scene: &mut Scene, request: &mut Request<'_>, made: &Made) {
    let text = made.program.text();
    program::text(scene, "", text.as_bytes());
    program::origins(scene, made.program.trace(), made.post.files(), text);
    program::picture(scene, "", &made.picture);
    let notes: Vec<Value> = made.program.notes().iter().map(|diag| form::finding(diag, made.post.files())).collect();
    scene.say("notes", json!(notes));
    if request.proves {
        let options = answered(&made.post, &request.options);
        let proven = made.post.verify_with(request.job.again(), Cursor::new(text), &options, &request.proof);
        scene.say("verdict", verdict::verdict(proven, made.program.trace(), made.post.files()));
    }
    let options = diff::Options { deadline: request.deadline, ..diff::Options::default() };
    if let Some((name, old)) = request.against {
        compare::against(scene, name, old, text, made.settings, &options);
    }
    if let Some((form, files)) = request.saved.take() {
        let saved = Request {
            form,
            files,
            limits: request.limits,
            levels: request.levels,
            job: request.job.again(),
            job_name: request.job_name,
            options: request.options.clone(),
            proof: request.proof.clone(),
            against: None,
            saved: None,
            proves: false,
            deadline: None,
        };
        compare::saved(scene, saved, text, &options);
    }
}
