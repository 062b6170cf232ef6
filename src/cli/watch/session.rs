//! What a page is shown: a form, jobs, and a program to compare with, read anew each time from their files.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use postform::internals::diff::Deadline;
use postform::internals::lint::Levels;
use postform::internals::scene::{Request, Scene, scene};
use postform::{Files, Limits, Options, Proof, Source};
use serde::Deserialize;
use serde_json::json;

use super::super::args::{LimitsArg, ReadArgs, WatchArgs};
use super::super::config::Config;
use super::super::files::{self, io_message};
use super::super::forms::FormFile;
use super::super::output::write_whole;
use super::super::prompt;

/// How long programs are compared for the shortest answer.
const PATIENCE: Duration = Duration::from_millis(800);

/// What a page asks.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ask {
    /// Which job, from 0.
    job: usize,
    /// Texts of forms that are not saved, by their names.
    #[serde(default)]
    texts: HashMap<String, String>,
    /// Is the program proven, too?
    #[serde(default)]
    proves: bool,
}

impl Ask {
    /// The program of what is asked is proven.
    pub fn proving(self) -> Ask {
        Ask { proves: true, ..self }
    }
}

/// A form to be written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Save {
    /// Name of the file, as the scene gave it.
    name: String,
    /// The text to save.
    text: String,
    /// What was on the disk when it was read.
    was: String,
}

/// Why a form was not written.
pub enum NotSaved {
    /// The file is none of the form's.
    Unknown,
    /// The file was changed meanwhile, or can't be written as it is.
    Conflict(String),
}

/// What is shown.
pub struct Session {
    form: PathBuf,
    jobs: Vec<PathBuf>,
    against: Option<PathBuf>,
    read: ReadArgs,
    limits: Limits,
    levels: Levels,
    options: Options,
    proof: Proof,
    config: Option<PathBuf>,
}

impl Session {
    /// Of what was typed.
    ///
    /// # Errors
    /// A message: a file can't be read, or an option makes no sense.
    pub fn open(args: WatchArgs) -> Result<Session, String> {
        let config = Config::near(&args.form)?;
        let limits = args.options.limits.map(LimitsArg::limits).or(config.limits).unwrap_or_default();
        for path in [Some(&args.form), args.against.as_ref()].into_iter().flatten().chain(&args.job) {
            if path == Path::new("-") {
                return Err("error: watch reads files that can be read again: - is none".into());
            }
        }
        let form = FormFile::read(&args.form, limits)?.analyse(&HashMap::new()).form;
        for job in &args.job {
            files::check_format(job, &args.read)?;
            files::open(job)?;
        }
        if let Some(against) = &args.against {
            files::open_program(against)?;
        }
        let mut options = args.options.options();
        options.shop_properties.clone_from(&config.properties);
        prompt::answers(&args.options.set, &form.settings.properties, &mut options)?;
        let proof = args.control.proof(None);
        Ok(Session {
            form: args.form,
            jobs: args.job,
            against: args.against,
            read: args.read,
            limits,
            levels: config.levels,
            options,
            proof,
            config: config.path,
        })
    }

    /// The files whose change is a change of the page.
    pub fn paths(&self) -> Vec<PathBuf> {
        let mut paths = match self.read_form() {
            Ok(form) => {
                form.analyse(&HashMap::new());
                form.paths()
            }
            Err(_) => vec![self.form.clone()],
        };
        paths.extend(self.jobs.iter().chain(&self.against).chain(&self.config).cloned());
        paths
    }

    /// What the page shows.
    ///
    /// # Errors
    /// A message: a file can't be read.
    pub fn scene(&self, ask: &Ask) -> Result<Scene, String> {
        let form = self.read_form()?;
        let path = self.jobs.get(ask.job).ok_or("error: there is no such job")?;
        let job = files::job(path, &self.read, true)?;
        let against = match &self.against {
            Some(path) => Some((files::name(path), read(path)?)),
            None => None,
        };
        let on_disk = form.source();
        let typed = Typed { form: &form, texts: &ask.texts };
        let now = typed.of(form.source());
        let is_typed = !ask.texts.is_empty();
        let mut scene = scene(Request {
            form: now,
            files: &typed,
            limits: self.limits,
            levels: &self.levels,
            job,
            job_name: &files::name(path),
            options: self.options.clone(),
            proof: self.proof.clone(),
            against: against.as_ref().map(|(name, bytes)| (name.as_str(), bytes.as_slice())),
            saved: is_typed.then_some((on_disk, &form as &dyn Files)),
            proves: ask.proves,
            deadline: Some(Deadline { at: Instant::now() + PATIENCE, now: Instant::now }),
        });
        let names = scene.said("form").and_then(|form| form["files"].as_array().cloned()).unwrap_or_default();
        let texts: Vec<String> = names.iter().map(|name| self.text(&form, name.as_str().unwrap_or_default())).collect();
        scene.say("texts", json!(texts));
        scene.say("jobs", json!(self.jobs.iter().map(|path| files::name(path)).collect::<Vec<String>>()));
        Ok(scene)
    }

    fn read_form(&self) -> Result<FormFile, String> {
        FormFile::read(&self.form, self.limits)
    }

    /// A file of the form as it is on the disk.
    fn text(&self, form: &FormFile, name: &str) -> String {
        let path = form.place(name);
        files::read_form(&path).map_or_else(|_| String::new(), |bytes| Source::from_bytes(name, &bytes).text)
    }

    /// Writes a file of the form, and only such a file.
    ///
    /// # Errors
    /// It is none, was changed meanwhile, or can't be written.
    pub fn save(&self, save: &Save) -> Result<(), NotSaved> {
        let conflict = |why: String| NotSaved::Conflict(why);
        let form = self.read_form().map_err(conflict)?;
        let checked = form.analyse(&HashMap::new());
        if !checked.files.iter().any(|file| file.name == save.name) {
            return Err(NotSaved::Unknown);
        }
        let path = form.place(&save.name);
        let bytes = files::read_form(&path).map_err(conflict)?;
        let source = Source::from_bytes(save.name.as_str(), &bytes);
        if lines(&source.text) != lines(&save.was) {
            return Err(conflict("it was changed on the disk meanwhile".into()));
        }
        if source.was_windows_1252 {
            return Err(conflict("it is not UTF-8: save it as UTF-8 with an editor first".into()));
        }
        // line ends stay as they were
        let text = lines(&save.text);
        let text = if source.text.contains("\r\n") { text.replace('\n', "\r\n") } else { text };
        let mark: &[u8] = if bytes.starts_with(b"\xef\xbb\xbf") { b"\xef\xbb\xbf" } else { b"" };
        write_whole(&path, &[mark, text.as_bytes()].concat()).map_err(conflict)
    }
}

/// With `\n` alone.
fn lines(text: &str) -> String {
    text.replace("\r\n", "\n").replace('\r', "\n")
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| io_message("read", path, &error))
}

/// The files of a form, with what was typed instead of some of them.
struct Typed<'a> {
    form: &'a FormFile,
    texts: &'a HashMap<String, String>,
}

impl Typed<'_> {
    fn of(&self, source: Source) -> Source {
        match self.texts.get(&source.name) {
            Some(text) => Source::from_text(source.name, text.as_str()),
            None => source,
        }
    }
}

impl Files for Typed<'_> {
    fn read(&self, name: &str) -> Result<Source, String> {
        self.form.read(name).map(|source| self.of(source))
    }
}
