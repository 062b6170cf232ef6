//! What a page is shown: a form, jobs, and a program to compare with, read again each time from their files.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

use postform::internals::diff;
use postform::internals::lint::Levels;
use postform::internals::machine::Machine;
use postform::internals::post::sample_job;
use postform::internals::scene::{At, Printed, Request, Scene, behind, help, no_machine, program_of, scene};
use postform::{Files, Job, Limits, Options, Proof, Source};
use serde::Deserialize;
use serde_json::{Value, json};

use super::super::args::{LimitsArg, ReadArgs, WatchArgs};
use super::super::clock;
use super::super::config::Config;
use super::super::files::{self, io_message};
use super::super::forms::FormFile;
use super::super::machine;
use super::super::output::{write_new, write_whole};
use super::super::prompt;

/// A program of fewer bytes is proven before anybody sees that its picture waits.
const SMALL: usize = 256 << 10;

/// What a page asks.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ask {
    /// Which job, from 0.
    job: usize,
    /// Texts of forms that are not saved, by their names.
    #[serde(default)]
    texts: HashMap<String, String>,
    /// The program that the page shows, as its scene said it.
    #[serde(default)]
    shown: Option<String>,
}

/// What a page asks of a word.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AskHelp {
    /// Which job, from 0.
    job: usize,
    /// Texts of forms that are not saved, by their names.
    #[serde(default)]
    texts: HashMap<String, String>,
    /// The word.
    at: At,
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
    /// The file of the machine that the command line or postform.toml names; the form's own stands between them.
    machine: [Option<PathBuf>; 2],
    /// Names of the jobs, as they are shown.
    names: Vec<String>,
    /// How often files were changed.
    generation: AtomicU64,
    saved: Mutex<Option<Saved>>,
    /// The files of the form as it was shown last, typed and not saved.
    shown: Mutex<Vec<PathBuf>>,
}

/// What the form printed for a job as it was saved.
#[derive(Clone)]
struct Saved {
    job: usize,
    /// As of which change of the files.
    generation: u64,
    program: Arc<str>,
}

fn lock<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
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
        let form = FormFile::read(&args.form, limits).map_err(|error| match args.form.exists() {
            true => error,
            false => {
                let name = files::name(&args.form);
                format!("{error}\n  help: begin with one that prints: postform new --control fanuc -o {name}, or with an empty file")
            }
        })?;
        let form = form.analyse(&HashMap::new()).form;
        let jobs = if args.job.is_empty() { config.jobs.clone() } else { args.job };
        for job in &jobs {
            files::check_format(job, &args.read)?;
        }
        if let Some(against) = &args.against {
            files::open_program(against)?;
        }
        let mut options = args.options.options();
        options.shop_properties.clone_from(&config.properties);
        prompt::answers(&args.options.set, &form.settings.properties, &mut options)?;
        if options.clock.is_none() {
            options.clock = Some(clock::now()?);
        }
        let proof = args.control.proof(None);
        Ok(Session {
            form: args.form,
            names: match jobs.is_empty() {
                true => vec!["the sample job".to_owned()],
                false => jobs.iter().map(|path| files::name(path)).collect(),
            },
            jobs,
            against: args.against,
            read: args.read,
            limits,
            levels: config.levels,
            options,
            proof,
            config: config.path,
            machine: [args.machine.machine, config.machine],
            generation: AtomicU64::new(0),
            saved: Mutex::new(None),
            shown: Mutex::default(),
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
        let named = self.machine.iter().flatten();
        paths.extend(self.jobs.iter().chain(&self.against).chain(&self.config).chain(named).cloned());
        paths.extend(lock(&self.shown).iter().cloned());
        paths
    }

    /// Are the files of the form that is shown among these?
    pub fn watches(&self, paths: &[PathBuf]) -> bool {
        lock(&self.shown).iter().all(|path| paths.contains(path))
    }

    /// What the page shows: a scene, and what takes longer than the picture of a long program after it: its verdict, and what
    /// changed.
    ///
    /// # Errors
    /// A message: a file can't be read. Nothing was sent then.
    pub fn show(&self, ask: &Ask, send: &mut dyn FnMut(Scene)) -> Result<(), String> {
        let generation = self.generation.load(Ordering::Acquire);
        let form = self.read_form()?;
        let (mut scene, printed) = self.print(&form, ask)?;
        *lock(&self.shown) = form.paths();
        let against = match &self.against {
            Some(path) => Some((files::name(path), read(path)?)),
            None => None,
        };
        let names = scene.said("form").and_then(|form| form["files"].as_array().cloned()).unwrap_or_default();
        let texts: Vec<String> = names.iter().map(|name| self.text(&form, name.as_str().unwrap_or_default())).collect();
        scene.say("texts", json!(texts));
        scene.say("jobs", json!(self.names));
        let Some(printed) = printed else {
            send(scene);
            return Ok(());
        };
        let sample = self.sample(&form, &ask.texts);
        let machine = self.machine(&form, &ask.texts);
        let program = printed.fingerprint(&scene, against.as_ref().map_or(&[][..], |(_, old)| old));
        // most of what is typed prints what was there, and the page need not draw it again
        let same = ask.shown.as_ref() == Some(&program);
        scene.say("program", json!(program));
        if same {
            scene.say("same", json!(true));
            scene.without_sections();
        }
        let is_small = printed.text().len() < SMALL;
        if ask.texts.is_empty() {
            self.keep_saved(ask.job, generation, printed.text());
        }
        thread::scope(|scope| {
            let (sender, behind_it) = channel();
            let (proves, fits, compares) = (sender.clone(), sender.clone(), sender);
            let (printed, against) = (&printed, &against);
            if let Some(machine) = &machine {
                scope.spawn(move || {
                    let fit = match (machine, self.job(ask.job, sample)) {
                        (Err(why), _) => no_machine(why),
                        (Ok(machine), Ok(job)) => printed.fit(job, machine),
                        (Ok(_), Err(_)) => return,
                    };
                    _ = fits.send(("fit", fit));
                });
            } else {
                drop(fits);
            }
            scope.spawn(move || {
                // a job that can't be read any more is told by the next scene
                if let Ok(job) = self.job(ask.job, sample) {
                    _ = proves.send(("verdict", printed.verdict(job)));
                }
            });
            let (old, typed) = (against.as_ref(), !ask.texts.is_empty());
            if old.is_some() || typed {
                scope.spawn(move || {
                    if typed {
                        let before = self.saved_program(ask.job, generation);
                        let found = printed.since_saved(before.as_deref(), &diff::Options::default());
                        _ = found.map(|found| compares.send(("saved", found)));
                    }
                    let found = old.and_then(|(name, old)| printed.against(name, old, &diff::Options::default()));
                    _ = found.map(|found| compares.send(("against", found)));
                });
            } else {
                drop(compares);
            }
            if !same {
                printed.draw(&mut scene);
            }
            if let Some((_, old)) = old.filter(|_| !same) {
                printed.draw_old(&mut scene, old);
            }
            if is_small {
                behind_it.into_iter().for_each(|(name, value)| scene.say(name, value));
                send(scene);
            } else {
                behind_it.try_iter().for_each(|(name, value)| scene.say(name, value));
                send(scene);
                behind_it.into_iter().for_each(|(name, value)| send(behind(name, value)));
            }
        });
        Ok(())
    }

    /// The verdict on what a form prints as it was saved.
    ///
    /// # Errors
    /// A message: a file can't be read.
    pub fn verdict(&self, ask: &Ask) -> Result<Value, String> {
        let form = self.read_form()?;
        let (scene, printed) = self.print(&form, ask)?;
        Ok(match printed {
            Some(printed) => printed.verdict(self.job(ask.job, self.sample(&form, &ask.texts))?),
            None => json!({ "kind": "none", "text": scene.said("stopped").map(|stopped| stopped["message"].clone()) }),
        })
    }

    /// What is known of a place in a form.
    ///
    /// # Errors
    /// A message: a file can't be read.
    pub fn help(&self, ask: &AskHelp) -> Result<Value, String> {
        let form = self.read_form()?;
        Ok(help(self.request(&Typed { form: &form, texts: &ask.texts }, ask.job)?, &ask.at))
    }

    /// What a form prints.
    fn print(&self, form: &FormFile, ask: &Ask) -> Result<(Scene, Option<Printed>), String> {
        Ok(scene(self.request(&Typed { form, texts: &ask.texts }, ask.job)?))
    }

    fn request<'a>(&'a self, typed: &'a Typed<'a>, job: usize) -> Result<Request<'a>, String> {
        let mut options = self.options.clone();
        options.job_file = self.names.get(job).cloned();
        let machine = self.machine(typed.form, typed.texts).and_then(Result::ok);
        options.rates = machine.and_then(|machine| machine.rates().ok());
        Ok(Request {
            form: typed.of(typed.form.source()),
            files: typed,
            limits: self.limits,
            levels: &self.levels,
            job: match job < self.names.len() {
                true => self.job(job, self.sample(typed.form, typed.texts)).map_err(plain),
                false => return Err("error: there is no such job".into()),
            },
            job_name: self.names.get(job).map_or("", String::as_str),
            options,
            proof: self.proof.clone(),
        })
    }

    /// The machine into which programs must fit: by the command line, by the form, or by postform.toml.
    fn machine(&self, form: &FormFile, texts: &HashMap<String, String>) -> Option<Result<Machine, String>> {
        let of_form = || Some(form.place(form.analyse(texts).form.settings.machine_file.as_deref()?));
        let [first, last] = &self.machine;
        let path = first.clone().or_else(of_form).or_else(|| last.clone())?;
        Some(machine::read(&path).map_err(plain))
    }

    /// The sample job, where no job is named.
    fn sample(&self, form: &FormFile, texts: &HashMap<String, String>) -> Option<&'static str> {
        self.jobs.is_empty().then(|| sample_job(&form.analyse(texts).form.settings))
    }

    fn job(&self, job: usize, sample: Option<&'static str>) -> Result<Job<'static>, String> {
        if let Some(sample) = sample {
            return Ok(Job::json(sample));
        }
        files::job(self.jobs.get(job).ok_or("error: there is no such job")?, &self.read, true)
    }

    /// Files were changed: what was kept of them is worth nothing.
    pub fn forget(&self) {
        self.generation.fetch_add(1, Ordering::AcqRel);
    }

    /// What the form as it was saved prints for a job, printed once until a file is changed.
    fn saved_program(&self, job: usize, generation: u64) -> Option<Arc<str>> {
        let known = lock(&self.saved).clone().filter(|known| (known.job, known.generation) == (job, generation));
        if let Some(known) = known {
            return Some(known.program);
        }
        let form = self.read_form().ok()?;
        let program = program_of(self.request(&Typed { form: &form, texts: &HashMap::new() }, job).ok()?)?;
        Some(self.keep_saved(job, generation, &program))
    }

    fn keep_saved(&self, job: usize, generation: u64, program: &str) -> Arc<str> {
        let program: Arc<str> = program.into();
        *lock(&self.saved) = Some(Saved { job, generation, program: Arc::clone(&program) });
        program
    }

    fn read_form(&self) -> Result<FormFile, String> {
        FormFile::read(&self.form, self.limits)
    }

    /// A file of the form as it is on the disk.
    fn text(&self, form: &FormFile, name: &str) -> String {
        let path = form.place(name);
        files::read_form(&path).map_or_else(|_| String::new(), |bytes| Source::from_bytes(name, &bytes).text)
    }

    /// Where a file of the form was that is shown, and is not there any more.
    fn gone(&self, name: &str) -> Option<PathBuf> {
        let shown = lock(&self.shown);
        shown.iter().find(|path| files::name(path) == name && !path.exists()).cloned()
    }

    /// Is the form itself there?
    pub fn has_form(&self) -> bool {
        self.form.exists()
    }

    /// Writes a file of the form, and only such a file; again where it was deleted.
    ///
    /// # Errors
    /// It is none, was changed meanwhile, or can't be written.
    pub fn save(&self, save: &Save) -> Result<(), NotSaved> {
        let conflict = |why: String| NotSaved::Conflict(why);
        if let Some(path) = self.gone(&save.name) {
            let written = write_new(&path, save.text.as_bytes());
            self.forget();
            return written.map_err(|error| conflict(io_message("write", &path, &error)));
        }
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
        // line ends stay as they were
        let text = lines(&save.text);
        let text = if source.text.contains("\r\n") { text.replace('\n', "\r\n") } else { text };
        let mark: &[u8] = if bytes.starts_with(b"\xef\xbb\xbf") { b"\xef\xbb\xbf" } else { b"" };
        let text = source.encoded(&text).map_err(|letter| {
            conflict(format!("it is in Windows-1252, which has no {letter}: save it as UTF-8 with an editor first"))
        })?;
        write_whole(&path, &[mark, &text].concat()).map_err(conflict)?;
        self.forget();
        Ok(())
    }
}

/// A message without its first word.
fn plain(message: String) -> String {
    message.trim_start_matches("error: ").to_owned()
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
