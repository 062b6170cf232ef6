//! The files that have been read: no output may replace one of them.

use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

use super::identity::Identity;

static READ: Mutex<Inputs> = Mutex::new(Inputs { names: BTreeSet::new(), files: None });

struct Inputs {
    /// The paths of the files. The paths are kept, because a rewritten file is another file with the same path.
    names: BTreeSet<PathBuf>,
    /// The identities of the files, if the command reads many files and rewrites none of them.
    files: Option<HashSet<Identity>>,
}

/// Records that a file is read.
pub fn note(path: &Path) {
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(files) = &mut read.files {
        files.extend(Identity::of_input(path));
    } else {
        read.names.insert(path.to_path_buf());
    }
}

/// The paths of all files that have been read so far, in the order of their paths. Standard input is not a file.
pub fn all() -> Vec<PathBuf> {
    let read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    read.names.iter().filter(|path| path.as_path() != Path::new("-")).cloned().collect()
}

/// The time of the last change of all files read so far; `None`: one of the files no longer exists.
pub fn newest() -> Option<SystemTime> {
    let read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    let changed = read.names.iter().map(|path| path.metadata().and_then(|meta| meta.modified()).ok());
    changed.collect::<Option<Vec<_>>>()?.into_iter().max()
}

/// Declares that the command reads many files and rewrites none of these files. Each file is then identified only once.
pub fn are_many() {
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    read.files = Some(read.names.iter().filter_map(|path| Identity::of_input(path)).collect());
}

/// Whether an output would replace a file that was read.
pub fn holds(output: &Path) -> bool {
    let Some(output) = Identity::of_output(output) else { return false };
    let read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    match &read.files {
        Some(files) => files.contains(&output),
        None => read.names.iter().any(|path| Identity::of_input(path).as_ref() == Some(&output)),
    }
}
