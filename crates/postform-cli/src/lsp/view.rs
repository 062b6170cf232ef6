//! An open form: checked with the texts of the editor, and printed with the jobs of its folder.

use std::cell::OnceCell;
use std::fs;
use std::path::{Path, PathBuf};

use gen_lsp_types::Uri;
use postform::internals::ide::{Current, Document};
use postform::internals::lint::Changed;
use postform::internals::post::sample_program;
use postform::internals::sema::Checked;
use postform::{Job, NoFiles, Source};

use super::texts::{Text, Texts};
use super::uri;
use crate::callers;
use crate::config::Config;
use crate::files;
use crate::folders::stem_of_job;
use crate::forms::FormFile;

/// Largest job that is printed while the user types.
const LARGEST_JOB: u64 = 32 << 20;

/// A job of the form.
#[derive(Clone, Debug)]
pub struct JobText {
    /// The display name of the job: `bracket`.
    pub name: String,
    /// The file of the job.
    pub path: PathBuf,
    /// The text of the job; `Err`: the reason why it can't be read.
    pub bytes: Result<Vec<u8>, String>,
}

/// The results for an open form.
pub struct View {
    /// The form, with the forms that it calls. If the open file is a called form, the document is the calling form.
    pub document: Document,
    /// The number of the file that is open, among the files of the document.
    pub file: u32,
    /// The settings of the form's folder.
    pub config: Config,
    /// An error in the folder's postform.toml.
    pub trouble: Option<String>,
    /// The jobs that the form prints, the current one first.
    pub jobs: Vec<JobText>,
    currents: Vec<OnceCell<Option<Current>>>,
    sample: OnceCell<Option<Current>>,
    form: Option<FormFile>,
    open: Changed,
}

impl View {
    /// Checks an open form. `root` is the form that calls the open form, usually the open form itself; `job` is the job
    /// in the editor's settings.
    pub fn new(text: &Text, root: Option<&Path>, texts: &Texts, job: Option<&Path>) -> View {
        let Some(root) = root else { return View::without_file(text) };
        let (config, trouble) = match Config::near(root) {
            Ok(config) => (config, None),
            Err(message) => (Config::default(), Some(message)),
        };
        let open: Changed = texts
            .all()
            .filter_map(|open| Some((files::name(open.path.as_deref()?), open.source.text.clone())))
            .collect();
        let form = FormFile::open_in_editor(root, config.limits.unwrap_or_default());
        let checked = form.analyse(&open);
        let own = text.path.as_deref().map(files::name).unwrap_or_default();
        let file = checked.files.iter().position(|source| source.name == own);
        // the root contains a call of the open form, but the call fails
        let Some(file) = file.map(|file| file as u32) else { return View::new(text, text.path.as_deref(), texts, job) };
        let document = Document::of(checked, &config.levels).with_properties(&config.shop_properties());
        let jobs: Vec<JobText> = job
            .into_iter()
            .map(Path::to_path_buf)
            .chain(config.jobs.iter().cloned())
            .map(|path| job_text(path, texts))
            .collect();
        let currents = jobs.iter().map(|_| OnceCell::new()).collect();
        View { document, file, config, trouble, jobs, currents, sample: OnceCell::new(), form: Some(form), open }
    }

    /// A form that was never saved; it can't call other forms.
    fn without_file(text: &Text) -> View {
        let config = Config::default();
        let limits = config.limits.unwrap_or_default();
        let document = Document::new(text.source.clone(), &NoFiles, limits, &config.levels);
        View {
            document,
            file: 0,
            config,
            trouble: None,
            jobs: Vec::new(),
            currents: Vec::new(),
            sample: OnceCell::new(),
            form: None,
            open: Changed::new(),
        }
    }

    /// The text that is open.
    pub fn source(&self) -> &Source {
        &self.document.files()[self.file as usize]
    }

    /// The URI of one of the form's files.
    pub fn uri(&self, file: u32, texts: &Texts) -> Option<Uri> {
        let path = self.path(file)?;
        Some(texts.of_path(&path).map_or_else(|| uri::of_path(&path), |text| text.uri.clone()))
    }

    fn path(&self, file: u32) -> Option<PathBuf> {
        let source = self.document.files().get(file as usize)?;
        Some(self.form.as_ref()?.place(&source.name))
    }

    /// The result of printing a job with the form. Jobs are counted from 0, and the built-in job has the number after
    /// the last job. `None`: the form has errors, or the job can't be read.
    pub fn printed(&self, job: usize) -> Option<&Current> {
        let Some(text) = self.jobs.get(job) else {
            return self.sample.get_or_init(|| self.document.print_sample()).as_ref();
        };
        let print = || {
            let bytes = text.bytes.as_ref().ok()?;
            let job = Job::open(&text.path.to_string_lossy(), bytes).ok()?;
            self.document.print(&text.name, job)
        };
        self.currents[job].get_or_init(print).as_ref()
    }

    /// The current job: the first job that can be printed.
    pub fn current(&self) -> Option<&Current> {
        (0..=self.jobs.len()).find_map(|job| self.printed(job))
    }

    /// A view of this form and these jobs, with another text for the file that is open.
    pub fn with_text(&self, text: &str) -> View {
        let changed = Changed::from([(self.source().name.clone(), text.to_owned())]);
        let document =
            Document::of(self.analyse(&changed), &self.config.levels).with_properties(&self.config.shop_properties());
        View {
            document,
            file: self.file,
            config: self.config.clone(),
            trouble: None,
            currents: self.jobs.iter().map(|_| OnceCell::new()).collect(),
            jobs: self.jobs.clone(),
            sample: OnceCell::new(),
            form: None,
            open: changed,
        }
    }

    /// The form, with the changed texts in place of some files.
    pub fn analyse(&self, changed: &Changed) -> Checked {
        let mut all = self.open.clone();
        all.extend(changed.iter().map(|(name, text)| (name.clone(), text.clone())));
        match &self.form {
            Some(form) => form.analyse(&all),
            None => {
                let name = self.source().name.clone();
                let text = all.get(&name).cloned().unwrap_or_else(|| self.source().text.clone());
                let limits = self.config.limits.unwrap_or_default();
                postform::internals::sema::analyse(Source::from_text(name, text), limits, &mut |_| {
                    Err("is not saved in a folder yet".into())
                })
            }
        }
    }

    /// The program of the current job with the changed texts, without block numbers.
    pub fn program(&self, changed: &Changed) -> Option<String> {
        let checked = self.analyse(changed);
        let named = self.jobs.iter().find_map(|job| Some((&job.path, job.bytes.as_ref().ok()?)));
        let job = named.and_then(|(path, bytes)| Job::open(&path.to_string_lossy(), bytes).ok());
        sample_program(&checked, job).ok()?.ok()
    }
}

fn job_text(path: PathBuf, texts: &Texts) -> JobText {
    let bytes = match texts.of_path(&path) {
        Some(open) => Ok(open.source.text.clone().into_bytes()),
        None => read(&path),
    };
    JobText { name: job_name(&path), bytes, path }
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    match fs::metadata(path) {
        Ok(meta) if meta.len() > LARGEST_JOB => Err(format!(
            "{} is larger than {} MB: it is not printed while you type",
            files::name(path),
            LARGEST_JOB >> 20
        )),
        _ => fs::read(path).map_err(|error| files::io_message("read", path, &error)),
    }
}

/// The display name of a job: its file without extension; for a file called `job`, its folder.
fn job_name(path: &Path) -> String {
    let stem = stem_of_job(path);
    let folder = path.parent().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
    postform::internals::terminal::escaped(&if stem == "job" { folder.unwrap_or(stem) } else { stem })
}

/// The form of a folder that calls this file, directly or through another form; the file itself if no form calls it.
pub fn root_of(path: &Path, texts: &Texts) -> PathBuf {
    let mut root = path.to_path_buf();
    // the maximum depth of calls
    for _ in 0..8 {
        let text = |other: &Path| match texts.of_path(other) {
            Some(open) => open.source.text.clone(),
            None => callers::text(other),
        };
        match callers::caller(&root, &text).filter(|caller| caller != path) {
            Some(caller) => root = caller,
            None => break,
        }
    }
    root
}
