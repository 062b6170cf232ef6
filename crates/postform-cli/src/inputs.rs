//! The files that were read: no output may take the place of one.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::identity::Identity;

/// By their names: a file that is written again is another one under the same name.
static READ: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// A file is read.
pub fn note(path: &Path) {
    READ.lock().unwrap_or_else(PoisonError::into_inner).insert(path.to_path_buf());
}

/// Would an output take the place of a file that was read?
pub fn holds(output: &Path) -> bool {
    let Some(output) = Identity::of_output(output) else { return false };
    let read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    read.iter().any(|path| Identity::of_input(path).as_ref() == Some(&output))
}
