//! Forms from files, with the forms that they call.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

use postform::internals::lint::{Changed, parts};
use postform::internals::sema::{Checked, Limits, analyse, one_post};
use postform::{Files, Source};

use super::files::{self, io_message};
use super::say::message;

/// A form's file, with the files that it calls.
pub struct FormFile {
    /// The path of the form.
    pub path: PathBuf,
    bytes: Vec<u8>,
    /// The name of the post, if the file contains several.
    post: Option<String>,
    limits: Limits,
    /// The paths of the called files, by their names in messages.
    called: RefCell<HashMap<String, PathBuf>>,
}

impl FormFile {
    /// Reads a form. `Err` is a message: the file can't be read.
    pub fn read(path: &Path, limits: Limits) -> Result<FormFile, String> {
        let bytes = files::read_form(path)?;
        Ok(FormFile { path: path.to_path_buf(), bytes, post: None, limits, called: RefCell::default() })
    }

    /// Selects one post of the file by its name. `Err` is a message: the file contains no post with this name.
    pub fn of_post(self, post: Option<&str>) -> Result<FormFile, String> {
        let Some(name) = post else { return Ok(self) };
        if let Err(names) = one_post(self.source(), name) {
            let held = if names.is_empty() {
                "none has a `Name`".to_owned()
            } else {
                format!("there are {}", names.join(", "))
            };
            return Err(format!("error: {} has no post `{name}`\n  help: {held}", files::name(&self.path)));
        }
        Ok(FormFile { post: Some(name.to_owned()), ..self })
    }

    /// A form that is open in an editor. The text of the form is passed together with the changed texts.
    pub fn open_in_editor(path: &Path, limits: Limits) -> FormFile {
        let bytes = files::read_form(path).unwrap_or_default();
        FormFile { path: path.to_path_buf(), bytes, post: None, limits, called: RefCell::default() }
    }

    /// The bytes of the file.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The form's text.
    pub fn source(&self) -> Source {
        let whole = || Source::from_bytes(files::name(&self.path), &self.bytes);
        match &self.post {
            Some(post) => one_post(whole(), post).unwrap_or_else(|_| whole()),
            None => whole(),
        }
    }

    /// Analyses the form, with the changed texts in place of their files.
    pub fn analyse(&self, changed: &Changed) -> Checked {
        let form = self.source();
        let source = match changed.get(&form.name) {
            Some(text) => Source::from_text(form.name, text),
            None => form,
        };
        analyse(source, self.limits, &mut |name| {
            let source = self.read(name)?;
            Ok(match changed.get(&source.name) {
                Some(text) => Source::from_text(source.name, text),
                None => source,
            })
        })
    }

    /// The path of a file of the form. `name` is the file's name in messages.
    pub fn place(&self, name: &str) -> PathBuf {
        self.called.borrow().get(name).unwrap_or(&self.path).clone()
    }

    /// The form and the files that it calls, as far as they have been read.
    pub fn paths(&self) -> Vec<PathBuf> {
        std::iter::once(&self.path).chain(self.called.borrow().values()).cloned().collect()
    }

    /// The files that the form calls, as far as they have been read, with links resolved.
    fn calls(&self) -> Vec<PathBuf> {
        // most forms call no other form, so these forms are not read twice
        let calls =
            |line: &[u8]| line.trim_ascii_start().get(..4).is_some_and(|word| word.eq_ignore_ascii_case(b"Call"));
        if self.bytes.split(|&byte| byte == b'\n').any(calls) {
            self.analyse(&Changed::new());
        }
        self.called.borrow().values().filter_map(|place| place.canonicalize().ok()).collect()
    }
}

impl Files for FormFile {
    fn read(&self, name: &str) -> Result<Source, String> {
        let (place, bytes) = called(&self.path, name).inspect_err(|_| {
            // a missing file counts as called, so that its creation is noticed as a change
            let place = self.path.parent().unwrap_or(Path::new("")).join(name);
            let is_below = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
            if is_below && !place.exists() {
                self.called.borrow_mut().insert(files::name(&place), place);
            }
        })?;
        let name = files::name(&place);
        self.called.borrow_mut().insert(name.clone(), place);
        Ok(Source::from_bytes(name, &bytes))
    }
}

/// Reads a form that another form calls. The called file must be in the caller's folder or below, also after links are
/// followed. Messages name the called file by its path, so that the reader finds the file.
fn called(form: &Path, name: &str) -> Result<(PathBuf, Vec<u8>), String> {
    let folder = form.parent().unwrap_or(Path::new(""));
    let base = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let path = base.join(name);
    let (Ok(real), Ok(root)) = (path.canonicalize(), base.canonicalize()) else {
        return Err("can't be found".into());
    };
    if !real.starts_with(root) {
        return Err("is outside the form's folder".into());
    }
    if !real.is_file() {
        return Err("is not a file".into());
    }
    if form.canonicalize().is_ok_and(|form| form == real) {
        return Err("is this form itself".into());
    }
    let bytes = files::read_form(&real).map_err(|_| "can't be read".to_owned())?;
    Ok((folder.join(name), bytes))
}

/// Removes the forms that another of these forms calls, because a called form is checked with its caller and the
/// caller's settings. If two forms call each other, the first one stays. Duplicates are removed.
pub fn wholes(mut files: Vec<FormFile>) -> Vec<FormFile> {
    let real = |file: &FormFile| file.path.canonicalize().unwrap_or_else(|_| file.path.clone());
    let mut seen = HashSet::new();
    files.retain(|file| seen.insert(real(file)));
    let calls: Vec<(PathBuf, Vec<PathBuf>)> = files.iter().map(|file| (real(file), file.calls())).collect();
    let parts = parts(&calls);
    files.into_iter().zip(parts).filter(|(_, is_part)| !is_part).map(|(file, _)| file).collect()
}

/// The forms for these arguments: a folder stands for all `.pf` files in the folder and its subfolders, in the order of
/// their names.
pub fn named(paths: &[PathBuf]) -> Result<Vec<PathBuf>, String> {
    let mut forms = Vec::new();
    for path in paths {
        if path.is_dir() {
            let before = forms.len();
            let root = path.canonicalize().map_err(|error| io_message("read", path, &error))?;
            in_folder(path, &root, &mut forms)?;
            if forms.len() == before {
                return Err(format!("error: there is no form (.pf) in {}", files::name(path)));
            }
        } else {
            forms.push(path.clone());
        }
    }
    Ok(forms)
}

fn in_folder(folder: &Path, root: &Path, forms: &mut Vec<PathBuf>) -> Result<(), String> {
    let fail = |error| io_message("read", folder, &error);
    let entries = fs::read_dir(folder).map_err(fail)?.collect::<Result<Vec<_>, _>>().map_err(fail)?;
    let mut paths: Vec<PathBuf> = entries.iter().map(fs::DirEntry::path).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            // a link to a folder may lead back to a folder above
            if !path.is_symlink() {
                in_folder(&path, root, forms)?;
            }
        } else if files::is_form(&path) {
            match path.canonicalize() {
                // the target of a link inside the folder is found under its own name
                Ok(real) if path.is_symlink() && real.starts_with(root) && files::is_form(&real) => {}
                Ok(_) if path.is_symlink() => left_out(&path, "a link to a file that is not a form in this folder"),
                Ok(real) if !real.is_file() => left_out(&path, "not a file"),
                _ => forms.push(path),
            }
        }
    }
    Ok(())
}

/// Reports a skipped file: a fix must only change files of the folder, and reading a pipe would never end.
fn left_out(path: &Path, why: &str) {
    message(&format!("{}: left out ({why}); to check this form, give its name", files::name(path)));
}
