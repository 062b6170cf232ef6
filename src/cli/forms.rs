//! Forms from files, with those that they call.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use postform::sema::{Checked, Limits, analyse};
use postform::source::Source;

use super::args::LimitsArg;
use super::files::{self, io_message};

/// Text that stands for that of a file: by the file's name in messages.
pub type Changed = HashMap<String, String>;

/// Reads and analyses a form. `Err` is a message: the file can't be read.
pub fn load(path: &Path, limits: LimitsArg) -> Result<Checked, String> {
    Ok(with_changes(path, &files::read_form(path)?, limits, &Changed::new()))
}

/// Analyses a form of these bytes, with other text for the files that were changed.
pub fn with_changes(path: &Path, bytes: &[u8], limits: LimitsArg, changed: &Changed) -> Checked {
    let name = files::name(path);
    let source = match changed.get(&name) {
        Some(text) => Source::from_text(name, text),
        None => Source::from_bytes(name, bytes),
    };
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    let limits = match limits {
        LimitsArg::Classic => Limits::Classic,
        LimitsArg::Extended => Limits::Extended,
    };
    analyse(source, limits, &mut |name| {
        let source = called(path, &folder, name)?;
        Ok(match changed.get(&source.name) {
            Some(text) => Source::from_text(source.name, text),
            None => source,
        })
    })
}

/// Where a file of a form is: the form itself, or one that it calls.
pub fn place(form: &Path, file: usize, source: &Source) -> PathBuf {
    if file == 0 { form.to_path_buf() } else { PathBuf::from(&source.name) }
}

/// A form that another one calls: in its folder or below, also when links are followed. Its name is its path, so that
/// whoever reads a message finds it.
fn called(form: &Path, folder: &Path, name: &str) -> Result<Source, String> {
    let base = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let path = base.join(name);
    let (Ok(real), Ok(root)) = (path.canonicalize(), base.canonicalize()) else {
        return Err("can't be found".into());
    };
    if !real.starts_with(root) {
        return Err("is outside the form's folder".into());
    }
    if form.canonicalize().is_ok_and(|form| form == real) {
        return Err("is this form itself".into());
    }
    let bytes = files::read_form(&real).map_err(|_| "can't be read".to_owned())?;
    Ok(Source::from_bytes(files::name(&folder.join(name)), &bytes))
}

/// The forms that arguments name: a folder is all `.pf` files in it and below, in the order of their names.
pub fn named(paths: &[PathBuf]) -> Result<Vec<PathBuf>, String> {
    let mut forms = Vec::new();
    for path in paths {
        if path.is_dir() {
            let before = forms.len();
            in_folder(path, &mut forms)?;
            if forms.len() == before {
                return Err(format!("error: there is no form (.pf) in {}", files::name(path)));
            }
        } else {
            forms.push(path.clone());
        }
    }
    Ok(forms)
}

fn in_folder(folder: &Path, forms: &mut Vec<PathBuf>) -> Result<(), String> {
    let fail = |error| io_message("read", folder, &error);
    let entries = fs::read_dir(folder).map_err(fail)?.collect::<Result<Vec<_>, _>>().map_err(fail)?;
    let mut paths: Vec<PathBuf> = entries.iter().map(fs::DirEntry::path).collect();
    paths.sort();
    for path in paths {
        // a link to a folder may lead back to where it is
        let is_folder = path.is_dir() && !path.is_symlink();
        match path.extension().and_then(|extension| extension.to_str()) {
            _ if is_folder => in_folder(&path, forms)?,
            Some(extension) if extension.eq_ignore_ascii_case("pf") => forms.push(path),
            _ => {}
        }
    }
    Ok(())
}
