//! The contents of a page: a form, jobs, and a program to compare with. Form, jobs and program are read from their
//! files each time.

use std::collections::HashMap;
use std::io::Read as _;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, Scope};

use postform::internals::diff;
use postform::internals::lint::Levels;
use postform::internals::machine::Machine;
use postform::internals::post::sample_job;
use postform::internals::scene::{
    Printed, Request, Scene, behind, drawn, help, no_machine, prepare, program_of, scene,
};
use postform::{Files, Limits, Options, Proof, Source};
use serde_json::{Value, json};

use super::super::args::{LimitsArg, WatchArgs};
use super::super::clock;
use super::super::config::Config;
use super::super::files::{self, io_message};
use super::super::forms::FormFile;
use super::super::machine;
use super::super::output::{write_new, write_whole};
use super::super::prompt;
use super::ask::{Ask, AskHelp, Close, Save};
use super::growing::Growing;
use super::jobs::{Jobs, Opened};

/// A program with fewer bytes than this number is proven so fast that its picture can wait for the verdict.
const SMALL: usize = 256 << 10;

/// The reason why a form was not saved.
pub enum NotSaved {
    /// The file does not belong to the form.
    Unknown,
    /// The file was changed in the meantime, or can't be written.
    Conflict(String),
}

/// The settings and files of the page.
pub struct Session {
    form: PathBuf,
    jobs: Jobs,
    against: Option<PathBuf>,
    limits: Limits,
    levels: Levels,
    options: Options,
    proof: Proof,
    config: Option<PathBuf>,
    /// The machine file from the command line, and the machine file from postform.toml; the form's own machine ranks
    /// between them.
    machine: [Option<PathBuf>; 2],
    /// Number of changes of the files.
    generation: AtomicU64,
    saved: Mutex<Option<Saved>>,
    /// Locked while a form is compared with its file and written.
    saving: Mutex<()>,
    /// The files of the form that was shown last, including unsaved texts.
    shown: Mutex<Vec<PathBuf>>,
}

/// The program that a page shows, with the data for its verdict and its comparison.
struct Shown<'a> {
    ask: &'a Ask,
    job: &'a Opened,
    form: &'a FormFile,
    generation: u64,
    printed: Printed,
    /// The program to compare with: its name and its text.
    against: Option<(String, Vec<u8>)>,
}

/// The program that the saved form printed for a job.
#[derive(Clone)]
struct Saved {
    job: Opened,
    /// The properties that were set.
    properties: Vec<(String, String)>,
    /// The number of file changes at the time of printing.
    generation: u64,
    program: Arc<str>,
}

fn lock<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Session {
    /// A session with the arguments of the command line.
    ///
    /// # Errors
    /// A message: a file can't be read, or an option makes no sense.
    pub fn open(args: WatchArgs) -> Result<Session, String> {
        let config = Config::near(&args.form)?;
        let limits = args.options.limits.map(LimitsArg::limits).or(config.limits).unwrap_or_default();
        for path in [Some(&args.form), args.against.as_ref()].into_iter().flatten().chain(&args.job) {
            if path == Path::new("-") {
                return Err("error: watch needs files: standard input (-) can't be read again".into());
            }
        }
        let form = FormFile::read(&args.form, limits).map_err(|error| match args.form.exists() {
            true => error,
            false => {
                let name = files::name(&args.form);
                format!(
                    "{error}\n  help: start with a working form: postform new --control fanuc -o {name}, or with \
                    an empty file"
                )
            }
        })?;
        let form = form.analyse(&HashMap::new()).form;
        let jobs = Jobs::of(if args.job.is_empty() { &config.jobs } else { &args.job }, args.read)?;
        if let Some(against) = &args.against {
            files::open_program(against)?;
        }
        let mut options = args.options.options();
        options.shop_properties = config.shop_properties();
        prompt::answers(&args.options.set, &form.settings.properties, &mut options)?;
        if options.clock.is_none() {
            options.clock = Some(clock::now()?);
        }
        let proof = args.control.proof(None, config.control);
        Ok(Session {
            form: args.form,
            jobs,
            against: args.against,
            limits,
            levels: config.levels,
            options,
            proof,
            config: config.path,
            machine: [args.machine.machine, config.machine],
            generation: AtomicU64::new(0),
            saved: Mutex::new(None),
            saving: Mutex::new(()),
            shown: Mutex::default(),
        })
    }

    /// The files to watch for changes.
    pub fn paths(&self) -> Vec<PathBuf> {
        let mut paths = match self.read_form() {
            Ok(form) => {
                form.analyse(&HashMap::new());
                form.paths()
            }
            Err(_) => vec![self.form.clone()],
        };
        let named = self.machine.iter().flatten();
        paths.extend(
            self.jobs
                .paths()
                .into_iter()
                .chain([&self.against, &self.config].into_iter().flatten().chain(named).cloned()),
        );
        paths.extend(lock(&self.shown).iter().cloned());
        paths
    }

    /// Whether `paths` contains all files of the form that is shown.
    pub fn watches(&self, paths: &[PathBuf]) -> bool {
        lock(&self.shown).iter().all(|path| paths.contains(path))
    }

    /// Sends a scene for the page. The program is drawn while it is printed. The verdict and the changes follow in separate
    /// scenes if the program is long, because they take longer than the picture.
    ///
    /// # Errors
    /// A message: a file can't be read, so nothing was sent.
    pub fn show(&self, ask: &Ask, send: &mut dyn FnMut(Scene)) -> Result<(), String> {
        let generation = self.generation.load(Ordering::Acquire);
        let form = self.read_form()?;
        let job = &self.jobs.at(ask.job)?;
        self.jobs.keep(job);
        let typed = Typed { form: &form, texts: &ask.texts };
        let (mut scene, ready) = prepare(self.request(&typed, job, &ask.properties));
        *lock(&self.shown) = form.paths();
        let against = match &self.against {
            Some(path) => Some((files::name(path), read(path)?)),
            None => None,
        };
        let names = scene.said("form").and_then(|form| form["files"].as_array().cloned()).unwrap_or_default();
        let texts: Vec<String> = names.iter().map(|name| self.text(&form, name.as_str().unwrap_or_default())).collect();
        scene.say("texts", json!(texts));
        scene.say("jobs", json!(self.jobs.names()));
        let Some(ready) = ready else {
            send(scene);
            return Ok(());
        };
        let text = Growing::default();
        thread::scope(|scope| {
            let (settings, writer, reader) = (ready.settings(), text.writer(), text.reader());
            let drawing = scope.spawn(move || drawn(reader, settings));
            let Some(printed) = ready.print(&mut scene, &mut |part| writer.push(part)) else {
                send(scene);
                return;
            };
            let program = printed.fingerprint(&scene, against.as_ref().map_or(&[][..], |(_, old)| old));
            // most edits do not change the program, so the page need not draw it again
            let same = ask.shown.as_ref() == Some(&program);
            scene.say("program", json!(program));
            if same {
                drop(writer);
                scene.say("same", json!(true));
                scene.without_sections();
            } else {
                writer.finish();
            }
            if ask.texts.is_empty() {
                self.keep_saved(ask, job, generation, printed.text());
            }
            let shown = Shown { ask, job, form: &form, generation, printed, against };
            thread::scope(|scope| {
                let later = self.judge(scope, &shown);
                if !same {
                    scene.absorb(drawing.join().unwrap_or_else(|fault| resume_unwind(fault)));
                    if let Some((_, old)) = &shown.against {
                        shown.printed.draw_old(&mut scene, old);
                    }
                }
                let is_small = shown.printed.text().len() < SMALL;
                let now: Vec<Scene> = if is_small { later.iter().collect() } else { later.try_iter().collect() };
                now.into_iter().for_each(|more| scene.absorb(more));
                scene.without_known(&ask.has);
                send(scene);
                later.into_iter().for_each(send);
            });
        });
        Ok(())
    }

    /// Verifies the program and then compares it with other programs, both on another thread. The verdict comes first,
    /// because the page needs the verdict most. The results are scenes, in the order in which they are ready.
    fn judge<'s>(&'s self, scope: &'s Scope<'s, '_>, shown: &'s Shown<'_>) -> Receiver<Scene> {
        let Shown { ask, job, form, generation, printed, against } = shown;
        let (sender, results) = channel();
        let sample = self.sample(job, form, &ask.texts);
        if let Some(machine) = self.machine(form, &ask.texts) {
            let fits = sender.clone();
            scope.spawn(move || {
                let fit = match (machine, self.jobs.open(job, sample)) {
                    (Err(why), _) => no_machine(&why),
                    (Ok(machine), Ok(job)) => printed.fit(job, &machine),
                    (Ok(_), Err(_)) => return,
                };
                _ = fits.send(fit);
            });
        }
        scope.spawn(move || {
            // if the job can't be read any more, the next scene reports it
            if let Ok(job) = self.jobs.open(job, sample) {
                _ = sender.send(behind("verdict", printed.verdict(job)));
            }
            if let Ok(job) = self.jobs.open(job, sample) {
                _ = sender.send(behind("toolSizes", printed.tools(job)));
            }
            let options = diff::Options::default();
            if !ask.texts.is_empty() {
                let before = self.saved_program(ask, job, *generation);
                let found = printed.since_saved(before.as_deref(), &options);
                _ = found.map(|found| sender.send(behind("saved", found)));
            }
            let found = against.as_ref().and_then(|(name, old)| printed.against(name, old, &options));
            _ = found.map(|found| sender.send(behind("against", found)));
        });
        results
    }

    /// The verdict on the program of the saved form.
    ///
    /// # Errors
    /// A message: a file can't be read.
    pub fn verdict(&self, ask: &Ask) -> Result<Value, String> {
        let form = self.read_form()?;
        let job = &self.jobs.at(ask.job)?;
        let typed = Typed { form: &form, texts: &ask.texts };
        let (scene, printed) = scene(self.request(&typed, job, &ask.properties));
        Ok(match printed {
            Some(printed) => printed.verdict(self.jobs.open(job, self.sample(job, &form, &ask.texts))?),
            None => json!({ "kind": "none", "text": scene.said("stopped").map(|stopped| stopped["message"].clone()) }),
        })
    }

    /// The help for a location in a form.
    ///
    /// # Errors
    /// A message: a file can't be read.
    pub fn help(&self, ask: &AskHelp) -> Result<Value, String> {
        let form = self.read_form()?;
        let job = self.jobs.at(ask.job)?;
        Ok(help(self.request(&Typed { form: &form, texts: &ask.texts }, &job, &[]), &ask.at))
    }

    fn request<'a>(&'a self, typed: &'a Typed<'a>, job: &'a Opened, properties: &[(String, String)]) -> Request<'a> {
        let mut options = self.options.clone();
        options.job_file = Some(job.name.clone());
        let machine = self.machine(typed.form, typed.texts).and_then(Result::ok);
        options.rates = machine.and_then(|machine| machine.rates().ok());
        Request {
            form: typed.of(typed.form.source()),
            files: typed,
            limits: self.limits,
            levels: &self.levels,
            job: self.jobs.open(job, self.sample(job, typed.form, typed.texts)).map_err(plain),
            job_name: &job.name,
            options,
            properties: properties.to_vec(),
            proof: self.proof.clone(),
        }
    }

    /// The machine into which programs must fit: from the command line, else from the form, else from postform.toml.
    fn machine(&self, form: &FormFile, texts: &HashMap<String, String>) -> Option<Result<Machine, String>> {
        let of_form = || Some(form.place(form.analyse(texts).form.settings.machine_file.as_deref()?));
        let [first, last] = &self.machine;
        let path = first.clone().or_else(of_form).or_else(|| last.clone())?;
        Some(machine::read(&path).map_err(plain))
    }

    /// The text of the sample job, if `job` is the sample job.
    fn sample(&self, job: &Opened, form: &FormFile, texts: &HashMap<String, String>) -> Option<&'static str> {
        job.is_sample().then(|| sample_job(&form.analyse(texts).form.settings))
    }

    /// Opens another job. Returns the tab of the job, and whether the job replaced another one.
    ///
    /// # Errors
    /// A message: the content is not a job.
    pub fn add(&self, name: &str, bytes: Vec<u8>) -> Result<(usize, bool), String> {
        let added = self.jobs.add(name, bytes)?;
        self.forget();
        Ok(added)
    }

    /// Closes a job.
    pub fn close(&self, close: &Close) {
        self.jobs.close(close);
        self.forget();
    }

    /// Drops the results from the old files after a change of files.
    pub fn forget(&self) {
        self.generation.fetch_add(1, Ordering::AcqRel);
    }

    /// The program that the saved form prints for a job. The program is printed only once until a file is changed.
    fn saved_program(&self, ask: &Ask, job: &Opened, generation: u64) -> Option<Arc<str>> {
        let same =
            |known: &Saved| (&known.job, known.generation, &known.properties) == (job, generation, &ask.properties);
        let known = lock(&self.saved).clone().filter(same);
        if let Some(known) = known {
            return Some(known.program);
        }
        let form = self.read_form().ok()?;
        let program = program_of(self.request(&Typed { form: &form, texts: &HashMap::new() }, job, &ask.properties))?;
        Some(self.keep_saved(ask, job, generation, &program))
    }

    fn keep_saved(&self, ask: &Ask, job: &Opened, generation: u64, program: &str) -> Arc<str> {
        let program: Arc<str> = program.into();
        *lock(&self.saved) = Some(Saved {
            job: job.clone(),
            properties: ask.properties.clone(),
            generation,
            program: Arc::clone(&program),
        });
        program
    }

    fn read_form(&self) -> Result<FormFile, String> {
        FormFile::read(&self.form, self.limits)
    }

    /// A file of the form on the disk.
    fn text(&self, form: &FormFile, name: &str) -> String {
        let path = form.place(name);
        files::read_form(&path).map_or_else(|_| String::new(), |bytes| Source::from_bytes(name, &bytes).text)
    }

    /// The path of a missing file that belongs to the form last shown.
    fn gone(&self, name: &str) -> Option<PathBuf> {
        let shown = lock(&self.shown);
        shown.iter().find(|path| files::name(path) == name && !path.exists()).cloned()
    }

    /// Whether the file of the form itself exists.
    pub fn has_form(&self) -> bool {
        self.form.exists()
    }

    /// Saves a file, but only if it belongs to the form; a deleted file is created again.
    ///
    /// # Errors
    /// The file does not belong to the form, was changed in the meantime, or can't be written.
    pub fn save(&self, save: &Save) -> Result<(), NotSaved> {
        let conflict = |why: String| NotSaved::Conflict(plain(why));
        if save.text.len() as u64 > files::LARGEST_FORM {
            return Err(conflict(format!(
                "it is larger than {} KB, and could not be read again",
                files::LARGEST_FORM >> 10
            )));
        }
        // if two pages save at the same time, the second page finds the text that the first page has written
        let _saving = lock(&self.saving);
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
            return Err(conflict("the file has changed on the disk".into()));
        }
        // the kind of line ends is kept
        let text = lines(&save.text);
        let text = if source.text.contains("\r\n") { text.replace('\n', "\r\n") } else { text };
        let mark: &[u8] = if bytes.starts_with(b"\xef\xbb\xbf") { b"\xef\xbb\xbf" } else { b"" };
        let text = source.encoded(&text).map_err(|letter| {
            conflict(format!(
                "the file is in Windows-1252, which has no {letter}: save it as UTF-8 with an editor first"
            ))
        })?;
        write_whole(&path, &[mark, &text].concat()).map_err(conflict)?;
        self.forget();
        Ok(())
    }
}

/// A message without `error:` at its beginning.
fn plain(message: String) -> String {
    message.trim_start_matches("error: ").to_owned()
}

/// The text with `\n` as the only line end.
fn lines(text: &str) -> String {
    text.replace("\r\n", "\n").replace('\r', "\n")
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    files::open(path)?.read_to_end(&mut bytes).map_err(|error| io_message("read", path, &error))?;
    Ok(bytes)
}

/// The files of a form, with unsaved texts in place of some of them.
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
