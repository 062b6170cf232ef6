//! Finds the form that calls a file. A file that a form calls is a form, too.

use std::fs;
use std::path::{Path, PathBuf};

use postform::Source;
use postform::internals::lang::CommandId;
use postform::internals::syntax::{Statement, parse};

use super::config::Config;
use super::files;

/// Maximum number of forms of a folder that are searched for calls.
const MOST_FORMS: usize = 200;

/// Whether a file is a form. A file is a form if it has the name of a form, if postform.toml names the file, or if a
/// form calls the file.
///
/// # Errors
/// A message: postform.toml makes no sense.
pub fn is_form(path: &Path) -> Result<bool, String> {
    // a missing file is reported when it is read
    let Ok(real) = path.canonicalize() else { return Ok(true) };
    if files::is_form(path) {
        return Ok(true);
    }
    let named = Config::near(&real)?.form.is_some_and(|form| form.canonicalize().is_ok_and(|form| form == real));
    Ok(named || caller(&real, &text).is_some())
}

/// The text of a form on the disk; empty if the file can't be read.
pub fn text(path: &Path) -> String {
    files::read_form(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default()
}

/// The form that calls a file. The file's folder and the folder above are searched for this form. `text` reads a form.
/// The returned path is absolute.
pub fn caller(path: &Path, text: &dyn Fn(&Path) -> String) -> Option<PathBuf> {
    let mut forms: Vec<PathBuf> = Vec::new();
    // a called form is in the folder of its caller or in a subfolder
    for folder in path.ancestors().skip(1).take(2) {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
        forms.extend(entries.filter(|other| files::is_form(other)).take(MOST_FORMS));
    }
    forms.sort();
    let calls = |other: &PathBuf| {
        let source = Source::from_text(files::name(other), text(other));
        let folder = files::folder(other);
        parse(&source, 0).statements().filter_map(called).any(|name| folder.join(name) == path)
    };
    forms.into_iter().filter(|other| other != path).find(calls)
}

/// The name of the file that a statement calls.
fn called(statement: &Statement) -> Option<String> {
    let calls = matches!(CommandId::parse(&statement.name.text), Some(CommandId::Call | CommandId::CallMe));
    calls.then(|| statement.argument())
}
