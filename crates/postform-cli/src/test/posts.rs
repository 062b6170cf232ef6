//! The tested forms; each is read once.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use postform::diag::Diag;
use postform::internals::lint::Changed;
use postform::internals::machine::Machine;
use postform::internals::sema::Checked;
use postform::{Limits, Options, Post, Proof};

use super::super::args::{MachineArg, TestArgs};
use super::super::config::{Config, shortened};
use super::super::files::{self, io_message};
use super::super::forms::FormFile;
use super::super::machine;
use super::super::report::Reporter;

/// A tested form.
pub struct Entry {
    /// The file of the form.
    pub path: PathBuf,
    /// The file's name without its extension; names of expected programs contain it.
    pub name: String,
    /// The name of the post, if the file contains several.
    of_post: Option<String>,
    /// The postform.toml of the jobs.
    of_jobs: Option<PathBuf>,
    /// The compiled form, or the reason why the form can't print.
    pub ready: Result<Ready, String>,
}

/// A form that can print.
pub struct Ready {
    /// The compiled form.
    pub post: Post,
    /// The options for printing.
    pub options: Options,
    /// The settings for proofs.
    pub proof: Proof,
    /// The machine into which the programs must fit, if one is named.
    pub machine: Option<Machine>,
    /// Whether a case fails if its program is not proven.
    pub require_proof: bool,
    /// The analysis of the form's files.
    pub checked: Checked,
}

/// Forms, each once for each postform.toml of jobs.
pub struct Posts {
    entries: Vec<Entry>,
    /// The forms of the command line, which replace the forms of postform.toml.
    named: Vec<PathBuf>,
    /// The post of the command line, which replaces the post of postform.toml.
    post: Option<String>,
    /// The forms that are given one by one, not by their folder.
    pub single: Vec<usize>,
}

impl Posts {
    /// The forms of the command line; there may be none.
    ///
    /// # Errors
    /// A message: a form does not exist.
    pub fn named(args: &TestArgs) -> Result<Posts, String> {
        for path in &args.forms {
            fs::metadata(path).map_err(|error| io_message("read", path, &error))?;
        }
        let (named, post) = (args.forms.clone(), args.post.clone());
        Ok(Posts { entries: Vec::new(), named, post, single: Vec::new() })
    }

    /// Whether there are forms on the command line.
    pub fn are_named(&self) -> bool {
        !self.named.is_empty()
    }

    /// The forms for jobs under this configuration.
    ///
    /// # Errors
    /// A message: a form does not exist, or two forms have the same name.
    pub fn under(&mut self, config: &Config) -> Result<Vec<usize>, String> {
        if self.are_named() {
            return self.of_paths(&self.named.clone(), config);
        }
        let of_shop = config.form.iter().filter(|_| config.test.forms.is_empty());
        let paths: Vec<PathBuf> = config.test.forms.iter().chain(of_shop).cloned().collect();
        self.of_paths(&paths, config).map_err(|error| match &config.path {
            Some(path) => {
                format!("{error}\n  help: {} names this form under [test]", files::name(&shortened(path.clone())))
            }
            None => error,
        })
    }

    fn of_paths(&mut self, paths: &[PathBuf], config: &Config) -> Result<Vec<usize>, String> {
        let mut all = Vec::new();
        for path in paths {
            if !path.is_dir() {
                let form = self.entry(path, config)?;
                self.single.push(self.first_of(form));
                all.push(form);
                continue;
            }
            let listed = fs::read_dir(path).map_err(|error| io_message("read", path, &error))?;
            let mut forms: Vec<PathBuf> = listed.flatten().map(|entry| entry.path()).collect();
            forms.retain(|form| files::is_form(form) && form.is_file());
            forms.sort();
            for form in forms {
                all.push(self.entry(&form, config)?);
            }
        }
        self.with_different_names(&all)?;
        Ok(all)
    }

    /// Checks that no two forms have the same name, because then they would have the same expected programs.
    fn with_different_names(&self, forms: &[usize]) -> Result<(), String> {
        let forms = forms.iter().map(|form| self.get(*form));
        let mut names: HashMap<&str, &Path> = HashMap::new();
        for Entry { name, path, .. } in forms {
            let other = *names.entry(name).or_insert(path);
            if other != path {
                return Err(format!(
                    "error: {} and {} would have the same expected programs: expected.{name}.nc\n  help: rename one \
                     of these forms, or test them with cases in separate folders, each with its own postform.toml",
                    files::name(other),
                    files::name(path)
                ));
            }
        }
        Ok(())
    }

    /// The number of a form by its path, for jobs under this configuration; the form is read if it is new.
    ///
    /// # Errors
    /// A message: the form does not exist.
    pub fn entry(&mut self, path: &Path, config: &Config) -> Result<usize, String> {
        let post = self.post.as_ref().or(config.test.post.as_ref());
        let path = &shortened(path.canonicalize().map_err(|error| io_message("read", path, &error))?);
        let is_it =
            |entry: &Entry| entry.path == *path && entry.of_post.as_ref() == post && entry.of_jobs == config.path;
        if let Some(at) = self.entries.iter().position(is_it) {
            return Ok(at);
        }
        files::check_regular(path)?;
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let (path, of_post, of_jobs) = (path.to_path_buf(), post.cloned(), config.path.clone());
        let ready = Ready::of(&path, of_post.as_deref(), config);
        self.entries.push(Entry { path, name, ready, of_post, of_jobs });
        Ok(self.entries.len() - 1)
    }

    /// A form by its number.
    pub fn get(&self, at: usize) -> &Entry {
        &self.entries[at]
    }

    /// The number of the first entry of the same form: there is an entry for each postform.toml of jobs.
    pub fn first_of(&self, at: usize) -> usize {
        let form = self.get(at);
        let is_same = |entry: &Entry| entry.path == form.path && entry.of_post == form.of_post;
        self.entries.iter().position(is_same).unwrap_or(at)
    }

    /// All tested forms.
    pub fn all(&self) -> &[Entry] {
        &self.entries
    }
}

impl Ready {
    /// Reads a form; `of_jobs` is the configuration for the jobs. `Err`: the reason why it can't print, for people.
    pub fn of(path: &Path, post: Option<&str>, of_jobs: &Config) -> Result<Ready, String> {
        let config = of_jobs.clone().over(Config::near(path)?);
        let limits: Limits = config.limits.unwrap_or_default();
        let file = FormFile::read(path, limits)?.of_post(post)?;
        let name = files::name(path);
        let post = Post::compile_with(file.source(), &file, limits, &config.levels).map_err(|error| {
            let found = error.into_findings();
            let errors: Vec<Diag> = found.diags.into_iter().filter(Diag::is_error).collect();
            format!("{name} has errors\n{}", Reporter::new(false).text(&errors, &found.files).trim_end())
        })?;
        config.check_properties(path, post.properties())?;
        let machine = machine::named(&MachineArg::default(), Some((path, &post)), &config)?;
        let mut options = Options::default();
        options.trace = true;
        options.shop_properties = config.shop_properties();
        options.rates = machine.as_ref().and_then(|machine| machine.rates().ok());
        let mut proof = Proof::default();
        proof.default_control = config.control;
        let require_proof = config.require_proof;
        Ok(Ready { post, options, proof, machine, require_proof, checked: file.analyse(&Changed::new()) })
    }
}
