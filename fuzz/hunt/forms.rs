//! The forms that jobs are printed with: those that ship, and unusual ones.

use std::fs;
use std::path::Path;

use crate::prove::Form;

/// All forms, by name.
///
/// # Panics
/// A form can't be read: that is a fault of this list.
pub fn forms() -> Vec<Form> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let mut paths: Vec<_> = ["postforms", "tests/data/forms"]
        .iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).into_iter().flatten().flatten())
        .map(|entry| entry.path())
        .collect();
    paths.sort();
    let read = |path: &std::path::PathBuf| {
        let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let text = fs::read_to_string(path).unwrap_or_default();
        Form::read(&name, &text).unwrap_or_else(|error| panic!("{error}"))
    };
    paths.iter().map(read).collect()
}
