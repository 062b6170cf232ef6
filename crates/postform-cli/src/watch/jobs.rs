//! The jobs of a page: those of the command line, and those that were opened in the page.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use postform::Job;
use postform::internals::post::KeptJob;
use postform::internals::terminal::escaped;

use super::super::args::ReadArgs;
use super::super::files::{self, Stamp};
use super::ask::Close;

/// The jobs, in the order of their tabs.
pub struct Jobs {
    list: Mutex<Vec<Opened>>,
    read: ReadArgs,
    /// The events of the job that was shown last.
    kept: Mutex<Option<Events>>,
}

/// Events of a job, and the state of its file when they were read.
struct Events {
    content: Content,
    stamp: Option<Stamp>,
    /// `None`: the job has too many events, or contains an error.
    job: Option<KeptJob>,
}

impl Events {
    /// Whether the events belong to this job, and whether its file was in this state when the events were read.
    fn is_of(&self, job: &Opened, stamp: Option<Stamp>) -> bool {
        self.content == job.content && self.stamp == stamp
    }
}

/// A file whose last change is more recent than this duration may change again without a new time stamp.
const SETTLED: Duration = Duration::from_secs(1);

/// Maximum number of events of a job that are kept: 300,000 events take 35 MB. The events of a longer job are read
/// again each time.
const MOST_KEPT: usize = 300_000;

/// A job.
#[derive(Clone, PartialEq)]
pub struct Opened {
    /// The display name of the job.
    pub name: String,
    content: Content,
}

#[derive(Clone, PartialEq)]
enum Content {
    /// A file, which is read again each time.
    File(PathBuf),
    /// The content of a file that was opened in the page.
    Memory(PathBuf, Arc<[u8]>),
    /// The sample job for the form's kind of machine.
    Sample,
}

impl Opened {
    /// The state of the file; `None` for a job in memory.
    fn stamp(&self) -> Option<Stamp> {
        match &self.content {
            Content::File(path) => files::stamp_of(path),
            _ => None,
        }
    }

    /// Whether this job is the sample job.
    pub fn is_sample(&self) -> bool {
        matches!(self.content, Content::Sample)
    }
}

impl Jobs {
    /// The jobs of these files.
    ///
    /// # Errors
    /// A message: the format of a file is unknown.
    pub fn of(paths: &[PathBuf], read: ReadArgs) -> Result<Jobs, String> {
        for path in paths {
            files::check_format(path, &read)?;
        }
        let opened = |path: &PathBuf| Opened { name: files::name(path), content: Content::File(path.clone()) };
        Ok(Jobs { list: Mutex::new(paths.iter().map(opened).collect()), read, kept: Mutex::default() })
    }

    fn list(&self) -> MutexGuard<'_, Vec<Opened>> {
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The names of the tabs.
    pub fn names(&self) -> Vec<String> {
        let list = self.list();
        if list.is_empty() { vec![sample().name] } else { list.iter().map(|job| job.name.clone()).collect() }
    }

    /// The files of the jobs.
    pub fn paths(&self) -> Vec<PathBuf> {
        let path = |job: &Opened| match &job.content {
            Content::File(path) => Some(path.clone()),
            _ => None,
        };
        self.list().iter().filter_map(path).collect()
    }

    /// The job of a tab.
    ///
    /// # Errors
    /// A message: the tab does not exist; another page may have closed the tab.
    pub fn at(&self, tab: usize) -> Result<Opened, String> {
        let list = self.list();
        match list.get(tab) {
            Some(job) => Ok(job.clone()),
            None if list.is_empty() && tab == 0 => Ok(sample()),
            None => Err("error: there is no such job".into()),
        }
    }

    /// Keeps the events of the job that is shown, because these events are needed several times for each keystroke in
    /// the form.
    pub fn keep(&self, job: &Opened) {
        let stamp = job.stamp();
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if job.is_sample() || kept.as_ref().is_some_and(|kept| kept.is_of(job, stamp)) {
            return;
        }
        *kept = None;
        if stamp.is_some_and(|(_, changed, _)| changed.elapsed().is_ok_and(|ago| ago < SETTLED)) {
            return;
        }
        let events = self.read(job, None).ok().and_then(|mut read| KeptJob::of(&mut read, MOST_KEPT));
        *kept = Some(Events { content: job.content.clone(), stamp, job: events });
    }

    /// Opens a job. `sample`: the text of the sample job.
    ///
    /// # Errors
    /// A message: its file can't be read.
    pub fn open(&self, job: &Opened, sample: Option<&'static str>) -> Result<Job<'static>, String> {
        match self.kept(job) {
            Some(kept) => Ok(kept),
            None => self.read(job, sample),
        }
    }

    fn kept(&self, job: &Opened) -> Option<Job<'static>> {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let same = kept.as_ref().filter(|kept| kept.is_of(job, job.stamp()))?;
        same.job.as_ref().map(KeptJob::job)
    }

    fn read(&self, job: &Opened, sample: Option<&'static str>) -> Result<Job<'static>, String> {
        match &job.content {
            Content::File(path) => files::job(path, &self.read, true),
            Content::Memory(name, bytes) => files::job_in_memory(name, bytes, &self.read),
            Content::Sample => Ok(Job::json(sample.unwrap_or_default())),
        }
    }

    /// Adds a job with the content of a file. A job of the same name that was added before is replaced. Returns the tab
    /// of the job, and whether the job replaced another one.
    ///
    /// # Errors
    /// A message: the content is not a job.
    pub fn add(&self, name: &str, bytes: Vec<u8>) -> Result<(usize, bool), String> {
        let path = Path::new(name).file_name().map(PathBuf::from).ok_or("error: a job needs a name")?;
        let bytes = files::unpacked_bytes(&path, bytes)?;
        files::job_in_memory(&path, &bytes, &self.read)?;
        let name = escaped(&path.to_string_lossy());
        let mut list = self.list();
        let before = list.iter().position(|job| matches!(&job.content, Content::Memory(known, _) if *known == path));
        let opened = Opened { name, content: Content::Memory(path, bytes) };
        if let Some(tab) = before {
            list[tab] = opened;
            return Ok((tab, true));
        }
        list.push(opened);
        Ok((list.len() - 1, false))
    }

    /// Removes the job of a tab. Nothing happens if the tab has another name now.
    pub fn close(&self, close: &Close) {
        let mut list = self.list();
        if list.get(close.job).is_some_and(|job| job.name == close.name) {
            list.remove(close.job);
        }
    }
}

fn sample() -> Opened {
    Opened { name: "the sample job".to_owned(), content: Content::Sample }
}
