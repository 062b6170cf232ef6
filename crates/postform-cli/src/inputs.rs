//! The files that were read: no output may replace one.

use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

use super::identity::Identity;

static READ: Mutex<Inputs> = Mutex::new(Inputs { names: BTreeSet::new(), files: None });

struct Inputs {
    /// By their names: a file that is written again is another one under the same name.
    names: BTreeSet<PathBuf>,
    /// The files themselves, where they are many and none is written again.
    files: Option<HashSet<Identity>>,
}

/// A file is read.
pub fn note(path: &Path) {
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(files) = &mut read.files {
        files.extend(Identity::of_input(path));
    } else {
        read.names.insert(path.to_path_buf());
    }
}

/// When one of the files that were read so far was changed last; `None`: one is not there any more.
pub fn newest() -> Option<SystemTime> {
    let read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    let changed = read.names.iter().map(|path| path.metadata().and_then(|meta| meta.modified()).ok());
    changed.collect::<Option<Vec<_>>>()?.into_iter().max()
}

/// Many files will be read, which nobody writes again while the command runs: each is looked at once.
pub fn are_many() {
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    read.files = Some(read.names.iter().filter_map(|path| Identity::of_input(path)).collect());
}

/// Would an output replace a file that was read?
pub fn holds(output: &Path) -> bool {
    let Some(output) = Identity::of_output(output) else { return false };
    let read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    match &read.files {
        Some(files) => files.contains(&output),
        None => read.names.iter().any(|path| Identity::of_input(path).as_ref() == Some(&output)),
    }
}
