//! The forms under test: each is read once.

use std::fs;
use std::path::{Path, PathBuf};

use postform::internals::lint::Changed;
use postform::internals::sema::Checked;
use postform::{Limits, Options, Post, Proof};

use super::super::clock;
use super::super::config::{Config, shortened};
use super::super::files::{self, io_message};
use super::super::forms::FormFile;

/// A form under test.
pub struct Entry {
    /// Its file.
    pub path: PathBuf,
    /// The file's name without its ending: expected programs have it in theirs.
    pub name: String,
    /// It prints, or why not.
    pub ready: Result<Ready, String>,
}

/// A form that prints.
pub struct Ready {
    /// What prints.
    pub post: Post,
    /// How it prints: nothing in a program depends on the day of the test.
    pub options: Options,
    /// How its programs are proven.
    pub proof: Proof,
    /// What its files mean.
    pub checked: Checked,
    /// A program that is not proven fails.
    pub require_proof: bool,
}

/// Forms, each once.
pub struct Posts {
    entries: Vec<Entry>,
    /// Those of the command line, which go before those of postform.toml.
    named: Option<Vec<usize>>,
}

/// The day on which programs are printed, unless [test] says another.
const DAY: &str = "2000-01-01T00:00";

impl Posts {
    /// The forms of the command line, which may be none.
    ///
    /// # Errors
    /// A message: a form is not there.
    pub fn named(forms: &[PathBuf]) -> Result<Posts, String> {
        let mut posts = Posts { entries: Vec::new(), named: None };
        if !forms.is_empty() {
            posts.named = Some(posts.of_paths(forms)?);
        }
        Ok(posts)
    }

    /// Were forms named on the command line?
    pub fn are_named(&self) -> bool {
        self.named.is_some()
    }

    /// The forms for jobs under this configuration.
    ///
    /// # Errors
    /// A message: a form is not there.
    pub fn under(&mut self, config: &Config) -> Result<Vec<usize>, String> {
        if let Some(named) = &self.named {
            return Ok(named.clone());
        }
        let of_shop = config.form.iter().filter(|_| config.test.forms.is_empty());
        let paths: Vec<PathBuf> = config.test.forms.iter().chain(of_shop).cloned().collect();
        self.of_paths(&paths)
    }

    fn of_paths(&mut self, paths: &[PathBuf]) -> Result<Vec<usize>, String> {
        let mut all = Vec::new();
        for path in paths {
            if !path.is_dir() {
                all.push(self.entry(path)?);
                continue;
            }
            let listed = fs::read_dir(path).map_err(|error| io_message("read", path, &error))?;
            let mut forms: Vec<PathBuf> = listed.flatten().map(|entry| entry.path()).collect();
            forms.retain(|form| files::is_form(form) && form.is_file());
            forms.sort();
            for form in forms {
                all.push(self.entry(&form)?);
            }
        }
        Ok(all)
    }

    /// A form by its path; read where it was not yet.
    ///
    /// # Errors
    /// A message: it is not there.
    pub fn entry(&mut self, path: &Path) -> Result<usize, String> {
        let path = &shortened(path.canonicalize().map_err(|error| io_message("read", path, &error))?);
        if let Some(at) = self.entries.iter().position(|entry| entry.path == *path) {
            return Ok(at);
        }
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        self.entries.push(Entry { path: path.to_path_buf(), name, ready: Ready::of(path) });
        Ok(self.entries.len() - 1)
    }

    /// A form by its number.
    pub fn get(&self, at: usize) -> &Entry {
        &self.entries[at]
    }

    /// All of them.
    pub fn all(&self) -> &[Entry] {
        &self.entries
    }
}

impl Ready {
    /// Reads a form. `Err`: why it can't print, for people.
    pub fn of(path: &Path) -> Result<Ready, String> {
        let config = Config::near(path)?;
        let limits: Limits = config.limits.unwrap_or_default();
        let file = FormFile::read(path, limits)?.of_post(config.test.post.as_deref())?;
        let name = files::name(path);
        let post = Post::compile_with(file.source(), &file, limits, &config.levels).map_err(|error| {
            let errors = error.findings().diags.iter().filter(|diag| diag.is_error()).count();
            format!("{name} has errors ({errors}): `postform lint {name}` shows them")
        })?;
        config.check_properties(post.properties())?;
        let mut options = Options::default();
        options.trace = true;
        options.shop_properties.clone_from(&config.properties);
        let day = config.test.date.as_deref().unwrap_or(DAY);
        options.clock = Some(clock::parse(day).map_err(|why| format!("date = {day:?} under [test]: {why}"))?);
        let mut proof = Proof::default();
        proof.control = post.control().is_none().then_some(config.control).flatten();
        Ok(Ready { post, options, proof, checked: file.analyse(&Changed::new()), require_proof: config.require_proof })
    }
}
