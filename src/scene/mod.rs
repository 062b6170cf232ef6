//! The data that the page shows about a form and a job, as one sequence of bytes.
//!
//! A [`Scene`] is a JSON head followed by named sections of numbers. Long data (points, blocks, their origins) are
//! sections, so that a program with a million moves loads fast. `page/src/scene.ts` reads these bytes. `postform watch`
//! sends a scene, a page of `postform plot` contains a scene, and the playground makes a scene in the browser.

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

use std::io::{Cursor, Read, Seek};

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
use crate::preflight::{Known, preflight_by_block};
use crate::sema::{Limits, analyse};
use crate::source::{Source, text_of};
use crate::terminal::escaped;
use crate::toolpath::Units;

/// The page of `postform watch`, as `page/` builds it.
pub const WATCH_PAGE: &str = include_str!("../../page/dist/watch.html");
/// The page of `postform plot`, as `page/` builds it, without a scene.
pub const PLOT_PAGE: &str = include_str!("../../page/dist/plot.html");

/// The input of a scene.
pub struct Request<'a> {
    /// The form.
    pub form: Source,
    /// The forms that the form calls.
    pub files: &'a dyn Files,
    /// Limits for the form.
    pub limits: Limits,
    /// Severities of the lint rules.
    pub levels: &'a Levels,
    /// The job, or the reason why it can't be read. If the job can't be read, the scene shows the reason and no
    /// program.
    pub job: Result<Job<'a>, String>,
    /// The name of the job.
    pub job_name: &'a str,
    /// Options for printing the job.
    pub options: Options,
    /// Values of the form's properties that were set in the page: names and texts. These values replace the values in
    /// `options`.
    pub properties: Vec<(String, String)>,
    /// Settings for running the program.
    pub proof: Proof,
}

/// A form without errors and a job, ready to be printed.
pub struct Ready<'a> {
    post: Post,
    job: Job<'a>,
    options: Options,
    proof: Proof,
    settings: RunSettings,
}

/// Checks a form and prints a job with it. The caller uses the returned [`Printed`] to draw, verify and compare the
/// program; these steps may run in parallel.
///
/// Errors are part of the scene: if the form has errors, the scene contains the findings and no program.
pub fn scene(request: Request<'_>) -> (Scene, Option<Printed>) {
    let (mut scene, ready) = prepare(request);
    let printed = ready.and_then(|ready| ready.print(&mut scene, &mut |_| {}));
    (scene, printed)
}

/// Checks a form and opens a job, without printing it yet. Errors are part of the scene.
pub fn prepare(request: Request<'_>) -> (Scene, Option<Ready<'_>>) {
    let mut scene = Scene::new();
    scene.say("job", json!({ "name": escaped(request.job_name) }));
    let checked = analyse(request.form, request.limits, &mut |name| request.files.read(name));
    let found = lint(&checked, request.levels);
    scene.say("form", form::form(&checked, &found.diags, found.suppressed));
    let post = match ready_of(&checked, found.diags) {
        Ok(ready) => Post::of(ready.program, ready.findings, &checked.files),
        Err(diags) => {
            let findings = Findings { diags, files: checked.files, suppressed: 0 };
            stopped(&mut scene, Error::form(findings), &[]);
            return (scene, None);
        }
    };
    let mut job = match request.job {
        Ok(job) => job,
        Err(why) => {
            scene.say("stopped", json!({ "by": "job", "message": why, "findings": [] }));
            return (scene, None);
        }
    };
    let options = answered(&post, &with_properties(&post, request.options, request.properties));
    // printing reports the error of a job that can't be read
    let units = options.units.or_else(|| job.units().ok().flatten()).unwrap_or(Units::Mm);
    let settings = post.run_settings(&request.proof, units);
    (scene, Some(Ready { post, job, options, proof: request.proof, settings }))
}

impl Ready<'_> {
    /// The settings with which the program is run.
    pub fn settings(&self) -> RunSettings {
        self.settings
    }

    /// Prints the job and adds the program to the scene. `take` receives the text in parts while it is printed. `None`: the job
    /// can't be printed; the scene contains the errors.
    pub fn print(self, scene: &mut Scene, take: &mut dyn FnMut(&[u8])) -> Option<Printed> {
        let Ready { post, mut job, options, proof, settings } = self;
        match post.printed(job.again(), &options, take) {
            Ok(program) => {
                program::text(scene, "", program.text());
                program::origins(scene, program.trace(), post.files(), program.text());
                let notes = program.notes().iter().map(|diag| form::finding(diag, post.files()));
                scene.say("notes", json!(notes.collect::<Vec<Value>>()));
                Some(Printed { post, program, options, proof, settings })
            }
            Err(error) => {
                stopped(scene, error, post.files());
                None
            }
        }
    }
}

/// The motions of a program, to be added to its scene. This function may read the program while the program is still
/// being printed.
pub fn drawn(program: impl Read + Seek, settings: RunSettings) -> Scene {
    let mut scene = Scene::new();
    match draw(program, settings) {
        Ok(picture) => program::picture(&mut scene, "", &picture),
        Err(error) => stopped(&mut scene, Error::from(error), &[]),
    }
    scene
}

/// A scene for an existing program and its picture.
pub fn of_program(name: &str, text: &[u8], picture: &Picture) -> Scene {
    let mut scene = Scene::new();
    scene.say("job", json!({ "name": escaped(name) }));
    program::text(&mut scene, "", &text_of(text));
    program::picture(&mut scene, "", picture);
    scene
}

/// A small scene with one value, which is sent after the main scene or becomes a part of the main scene.
pub fn behind(name: &str, value: Value) -> Scene {
    let mut scene = Scene::new();
    scene.say(name, value);
    scene
}

/// The program that a form prints for a job.
pub struct Printed {
    post: Post,
    program: Program,
    options: Options,
    proof: Proof,
    settings: RunSettings,
}

impl Printed {
    /// The text of the program.
    pub fn text(&self) -> &str {
        self.program.text()
    }

    /// A hash of everything that affects the drawing: the blocks, their form lines and job items, the run settings, and
    /// the old program.
    pub fn fingerprint(&self, scene: &Scene, old: &[u8]) -> String {
        scene.fingerprint(&format!("{:?}", self.settings), old)
    }

    /// Adds the motions of the program to the scene.
    pub fn draw(&self, scene: &mut Scene) {
        scene.absorb(drawn(Cursor::new(self.text()), self.settings));
    }

    /// The result of verifying the program against the job, for display in the page.
    pub fn verdict(&self, job: Job<'_>) -> Value {
        let proven = self.post.verify_with(job, Cursor::new(self.text()), &self.options, &self.proof);
        verdict::verdict(proven, self.program.trace(), self.post.files())
    }

    /// The check whether the program fits into a machine, and the time of each block on this machine, for display in
    /// the page.
    pub fn fit(&self, job: Job<'_>, machine: &Machine) -> Scene {
        let tools = self.post.job_tools(job).unwrap_or_default();
        let known = Known { tools, coolant: self.post.coolant_codes() };
        match preflight_by_block(Cursor::new(self.text()), self.settings, machine, &known) {
            Ok(fitted) => {
                let control = self.settings.control;
                let fit = fit::fit(&fitted, machine, control, self.program.trace(), self.post.files());
                let mut scene = behind("fit", fit);
                if !fitted.block_times.is_empty() {
                    fit::times(&mut scene, &fitted.block_times);
                }
                scene
            }
            Err(error) => no_machine(&error.to_string()),
        }
    }

    /// The tools of the job with their sizes in millimetres, for display in the page.
    pub fn tools(&self, job: Job<'_>) -> Value {
        let tools = self.post.job_tools(job).unwrap_or_default().into_iter();
        let rows =
            tools.map(|tool| json!({ "number": tool.number, "diameter": tool.diameter, "corner": tool.corner_radius }));
        rows.collect()
    }

    /// Adds the motions of an old program of the job to the scene.
    pub fn draw_old(&self, scene: &mut Scene, old: &[u8]) {
        compare::draw_old(scene, old, self.settings);
    }

    /// The blocks that differ from an old program, for display in the page. `None`: one of the programs is too long to compare.
    pub fn against(&self, name: &str, old: &[u8], options: &diff::Options) -> Option<Value> {
        compare::against(name, old, self.text(), options)
    }

    /// The blocks that differ from the program that the last saved form prints. `before` is `None` if the last saved
    /// form printed no program.
    pub fn since_saved(&self, before: Option<&str>, options: &diff::Options) -> Option<Value> {
        compare::saved(before, self.text(), options)
    }
}

/// The program that a form prints for a job, with the options of the page. `None`: no program can be printed; [`scene`]
/// reports the reason.
pub fn program_of(request: Request<'_>) -> Option<String> {
    let post = Post::compile_with(request.form, request.files, request.limits, request.levels).ok()?;
    let options = with_properties(&post, request.options, request.properties);
    let options = Options { trace: false, ..answered(&post, &options) };
    Some(post.render(request.job.ok()?, &options).ok()?.into_text())
}

/// Sets properties. A property that the form does not have any more is ignored: the user may be editing the form.
fn with_properties(post: &Post, mut options: Options, properties: Vec<(String, String)>) -> Options {
    for (name, value) in properties {
        if post.properties().iter().any(|property| property.name == name) {
            options.properties.retain(|(other, _)| !other.eq_ignore_ascii_case(&name));
            options.properties.push((name, value));
        }
    }
    options
}

/// Returns options that record the source map, and that contain the default of each prompt without an answer.
fn answered(post: &Post, options: &Options) -> Options {
    // no verification here: the scene also shows a program that differs from its job, and verifies it separately
    let mut options = Options { trace: true, proof: None, ..options.clone() };
    for prompt in post.prompts() {
        if !options.set.iter().any(|(name, _)| name == prompt.variable) {
            options.set.push((prompt.variable.to_owned(), prompt.default.unwrap_or(0.0)));
        }
    }
    options
}

/// Adds the reason why there is no program or no picture: `form`, `job` or `input`, the message in one line, and the errors.
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
