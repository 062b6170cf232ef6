//! The tested forms; each is read once.

use std::fs;
use std::path::{Path, PathBuf};

use postform::diag::Diag;
use postform::internals::lint::Changed;
use postform::internals::sema::Checked;
use postform::{Limits, Options, Post, Proof};

use super::super::config::{Config, shortened};
use super::super::files::{self, io_message};
use super::super::forms::FormFile;
use super::super::report::Reporter;

/// A tested form.
pub struct Entry {
    /// The file of the form.
    pub path: PathBuf,
    /// The file's name without its extension; names of expected programs contain it.
    pub name: String,
    /// The name of the post, if the file contains several.
    of_post: Option<String>,
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
    /// The analysis of the form's files.
    pub checked: Checked,
}

/// Forms, each once.
pub struct Posts {
    entries: Vec<Entry>,
    /// The forms of the command line, which replace the forms of postform.toml.
    named: Option<Vec<usize>>,
    /// The forms that are given one by one, not by their folder.
    pub single: Vec<usize>,
}

impl Posts {
    /// The forms of the command line; there may be none.
    ///
    /// # Errors
    /// A message: a form does not exist.
    pub fn named(forms: &[PathBuf]) -> Result<Posts, String> {
        let mut posts = Posts { entries: Vec::new(), named: None, single: Vec::new() };
        if !forms.is_empty() {
            posts.named = Some(posts.of_paths(forms, None)?);
        }
        Ok(posts)
    }

    /// Whether there are forms on the command line.
    pub fn are_named(&self) -> bool {
        self.named.is_some()
    }

    /// The forms for jobs under this configuration.
    ///
    /// # Errors
    /// A message: a form does not exist.
    pub fn under(&mut self, config: &Config) -> Result<Vec<usize>, String> {
        if let Some(named) = &self.named {
            return Ok(named.clone());
        }
        let of_shop = config.form.iter().filter(|_| config.test.forms.is_empty());
        let paths: Vec<PathBuf> = config.test.forms.iter().chain(of_shop).cloned().collect();
        self.of_paths(&paths, config.test.post.as_deref()).map_err(|error| match &config.path {
            Some(path) => {
                format!("{error}\n  help: {} names this form under [test]", files::name(&shortened(path.clone())))
            }
            None => error,
        })
    }

    fn of_paths(&mut self, paths: &[PathBuf], post: Option<&str>) -> Result<Vec<usize>, String> {
        let mut all = Vec::new();
        for path in paths {
            if !path.is_dir() {
                let form = self.entry(path, post)?;
                self.single.push(form);
                all.push(form);
                continue;
            }
            let listed = fs::read_dir(path).map_err(|error| io_message("read", path, &error))?;
            let mut forms: Vec<PathBuf> = listed.flatten().map(|entry| entry.path()).collect();
            forms.retain(|form| files::is_form(form) && form.is_file());
            forms.sort();
            for form in forms {
                all.push(self.entry(&form, post)?);
            }
        }
        Ok(all)
    }

    /// The number of a form by its path; the form is read if it is new.
    ///
    /// # Errors
    /// A message: the form does not exist.
    pub fn entry(&mut self, path: &Path, post: Option<&str>) -> Result<usize, String> {
        let path = &shortened(path.canonicalize().map_err(|error| io_message("read", path, &error))?);
        if let Some(at) = self.entries.iter().position(|entry| entry.path == *path && entry.of_post.as_deref() == post)
        {
            return Ok(at);
        }
        files::check_regular(path)?;
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let of_post = post.map(str::to_owned);
        self.entries.push(Entry { path: path.to_path_buf(), name, ready: Ready::of(path, post), of_post });
        Ok(self.entries.len() - 1)
    }

    /// A form by its number.
    pub fn get(&self, at: usize) -> &Entry {
        &self.entries[at]
    }

    /// All tested forms.
    pub fn all(&self) -> &[Entry] {
        &self.entries
    }
}

impl Ready {
    /// Reads a form. `Err`: the reason why it can't print, for people.
    pub fn of(path: &Path, post: Option<&str>) -> Result<Ready, String> {
        let config = Config::near(path)?;
        let limits: Limits = config.limits.unwrap_or_default();
        let file = FormFile::read(path, limits)?.of_post(post)?;
        let name = files::name(path);
        let post = Post::compile_with(file.source(), &file, limits, &config.levels).map_err(|error| {
            let found = error.into_findings();
            let errors: Vec<Diag> = found.diags.into_iter().filter(Diag::is_error).collect();
            format!("{name} has errors\n{}", Reporter::new(false).text(&errors, &found.files).trim_end())
        })?;
        config.check_properties(path, post.properties())?;
        let mut options = Options::default();
        options.trace = true;
        options.shop_properties = config.shop_properties();
        let mut proof = Proof::default();
        proof.control = post.control().is_none().then_some(config.control).flatten();
        Ok(Ready { post, options, proof, checked: file.analyse(&Changed::new()) })
    }
}
