//! Everything that the page shows of a form and a job, as one run of bytes.
//!
//! A [`Scene`] is a JSON head and named sections of numbers after it: what is long (points, blocks, their places) is not JSON, so that
//! a program of a million moves is there at once. `page/src/scene.ts` reads it; the same bytes come from `postform watch`, stand in
//! a page of `postform plot`, and are made in the browser by the playground.

mod compare;
mod fit;
mod form;
mod help;
mod pack;
mod program;
mod verdict;

pub use fit::no_machine;
pub use help::{At, help};
pub use pack::Scene;

use std::io::Cursor;

use serde_json::{Value, json};

use crate::diag::Findings;
use crate::diff;
use crate::error::{Error, ErrorKind};
use crate::job::Job;
use crate::lint::{Levels, lint, ready_of};
use crate::machine::Machine;
use crate::nc::RunSettings;
use crate::picture::{Picture, draw};
use crate::post::{Files, Options, Post, Program, Proof};
use crate::preflight::preflight;
use crate::sema::{Limits, analyse};
use crate::source::Source;
use crate::terminal::escaped;
use crate::toolpath::Units;

/// The page of `postform watch`, as `page/` builds it.
pub const WATCH_PAGE: &str = include_str!("../../page/dist/watch.html");
/// The page of `postform plot` without a scene, as `page/` builds it.
pub const PLOT_PAGE: &str = include_str!("../../page/dist/plot.html");

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
    /// The job; or why it can't be read, which the scene shows in place of the program.
    pub job: Result<Job<'a>, String>,
    /// What the job is called.
    pub job_name: &'a str,
    /// How the job is printed.
    pub options: Options,
    /// How the program is run.
    pub proof: Proof,
}

/// A form, and what it prints for a job. What that does, whether it is what the job asks for and what changed are said by what was
/// printed: drawing, proving and comparing may go on side by side.
///
/// What is wrong is in the scene: a form with errors has findings and no program.
pub fn scene(request: Request<'_>) -> (Scene, Option<Printed>) {
    let mut scene = Scene::new();
    scene.say("job", json!({ "name": escaped(request.job_name) }));
    let checked = analyse(request.form, request.limits, &mut |name| request.files.read(name));
    let found = lint(&checked, request.levels);
    scene.say("form", form::form(&checked.files, &found.diags, found.suppressed));
    let post = match ready_of(&checked, found.diags) {
        Ok(ready) => Post::of(ready.program, ready.findings, &checked.files),
        Err(diags) => {
            let findings = Findings { diags, files: checked.files, suppressed: 0 };
            stopped(&mut scene, Error::form(findings), &[]);
            return (scene, None);
        }
    };
    let job = match request.job {
        Ok(job) => job,
        Err(why) => {
            scene.say("stopped", json!({ "by": "job", "message": why, "findings": [] }));
            return (scene, None);
        }
    };
    match Printed::new(&post, job, &request.options, request.proof) {
        Ok(printed) => {
            let text = printed.text();
            program::text(&mut scene, "", text.as_bytes());
            program::origins(&mut scene, printed.program.trace(), post.files(), text);
            let notes = printed.program.notes().iter().map(|diag| form::finding(diag, post.files()));
            scene.say("notes", json!(notes.collect::<Vec<Value>>()));
            (scene, Some(printed))
        }
        Err(error) => {
            stopped(&mut scene, error, post.files());
            (scene, None)
        }
    }
}

/// A program that is there, and what it does.
pub fn of_program(name: &str, text: &[u8], picture: &Picture) -> Scene {
    let mut scene = Scene::new();
    scene.say("job", json!({ "name": escaped(name) }));
    program::text(&mut scene, "", text);
    program::picture(&mut scene, "", picture);
    scene
}

/// Something that is said after a scene, of what is in it.
pub fn behind(name: &str, value: Value) -> Scene {
    let mut scene = Scene::new();
    scene.say(name, value);
    scene
}

/// What a form makes of a job.
pub struct Printed {
    post: Post,
    program: Program,
    options: Options,
    proof: Proof,
    settings: RunSettings,
}

impl Printed {
    fn new(post: &Post, mut job: Job<'_>, options: &Options, proof: Proof) -> Result<Printed, Error> {
        let options = answered(post, options);
        let program = post.render(job.again(), &options)?;
        let units = match options.units {
            Some(units) => units,
            None => job.units()?.unwrap_or(Units::Mm),
        };
        let settings = post.run_settings(&proof, units);
        Ok(Printed { post: post.clone(), program, options, proof, settings })
    }

    /// The program.
    pub fn text(&self) -> &str {
        self.program.text()
    }

    /// What tells what is drawn from others: the blocks, the lines and items that they come from, how they are run, and the program
    /// of before.
    pub fn fingerprint(&self, scene: &Scene, old: &[u8]) -> String {
        scene.fingerprint(&format!("{:?}", self.settings), old)
    }

    /// Says what the program does.
    pub fn draw(&self, scene: &mut Scene) {
        match draw(Cursor::new(self.text()), self.settings) {
            Ok(picture) => program::picture(scene, "", &picture),
            Err(error) => stopped(scene, Error::from(error), self.post.files()),
        }
    }

    /// Whether the program does what its job asks for: what the page shows of it.
    pub fn verdict(&self, job: Job<'_>) -> Value {
        let proven = self.post.verify_with(job, Cursor::new(self.text()), &self.options, &self.proof);
        verdict::verdict(proven, self.program.trace(), self.post.files())
    }

    /// Whether the program fits into a machine: what the page shows of it.
    pub fn fit(&self, job: Job<'_>, machine: &Machine) -> Value {
        let tools = self.post.job_tools(job).unwrap_or_default();
        match preflight(Cursor::new(self.text()), self.settings, machine, &tools) {
            Ok(fitted) => fit::fit(&fitted, machine, self.settings.control, self.program.trace(), self.post.files()),
            Err(error) => no_machine(&error.to_string()),
        }
    }

    /// Says what another program of the job does.
    pub fn draw_old(&self, scene: &mut Scene, old: &[u8]) {
        compare::draw_old(scene, old, self.settings);
    }

    /// Which blocks are others than in that program: what the page shows of it. `None`: one of them is too long to compare.
    pub fn against(&self, name: &str, old: &[u8], options: &diff::Options) -> Option<Value> {
        compare::against(name, old, self.text(), options)
    }

    /// Which blocks are others than those that the form printed as it was saved; before is `None`: it printed none.
    pub fn since_saved(&self, before: Option<&str>, options: &diff::Options) -> Option<Value> {
        compare::saved(before, self.text(), options)
    }
}

/// The program that a form prints for a job as the page asks for it; `None`: it can't be printed, and why is told where it is shown.
pub fn program_of(request: Request<'_>) -> Option<String> {
    let post = Post::compile_with(request.form, request.files, request.limits, request.levels).ok()?;
    let options = Options { trace: false, ..answered(&post, &request.options) };
    Some(post.render(request.job.ok()?, &options).ok()?.into_text())
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

/// Why there is no program, or no picture of it: `form`, `job` or `input`, all of it in a line, and the errors.
fn stopped(scene: &mut Scene, error: Error, files: &[Source]) {
    let by = match error.kind() {
        ErrorKind::Form => "form",
        ErrorKind::Job | ErrorKind::Fault => "job",
        _ => "input",
    };
    let message = error.to_string();
    let findings = error.into_findings();
    let files = if files.is_empty() { &findings.files } else { files };
    let errors = findings.diags.iter().filter(|diag| diag.is_error()).map(|diag| form::finding(diag, files));
    scene.say("stopped", json!({ "by": by, "message": message, "findings": errors.collect::<Vec<Value>>() }));
}
