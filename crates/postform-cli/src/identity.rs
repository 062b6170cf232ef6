//! The identity of a file: different names, links and folders may lead to the same file.

use std::ffi::{OsStr, OsString};
use std::io;
use std::path::Path;

use super::destination::{destination, folder};

/// A regular file, or the location of a file that does not exist yet.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Identity {
    /// The file, or the folder of a file that does not exist yet.
    node: Node,
    /// The name of a file that does not exist yet.
    name: Option<OsString>,
}

/// Device and inode number.
#[cfg(unix)]
type Node = (u64, u64);
/// The path without links.
#[cfg(not(unix))]
type Node = std::path::PathBuf;

impl Identity {
    /// The identity of an input. `None`: the input is no regular file, so no output can replace the input.
    pub fn of_input(path: &Path) -> Option<Identity> {
        if path == Path::new("-") {
            return of_stream(&io::stdin());
        }
        path.metadata().is_ok_and(|meta| meta.is_file()).then(|| of_path(path, None))?
    }

    /// The identity of an output, which may not exist yet.
    pub fn of_output(path: &Path) -> Option<Identity> {
        if path == Path::new("-") {
            return of_stream(&io::stdout());
        }
        let path = destination(path).ok()?.path;
        match path.metadata() {
            Ok(_) => Identity::of_input(&path),
            Err(_) => of_path(folder(&path), path.file_name()),
        }
    }
}

#[cfg(unix)]
fn of_path(path: &Path, name: Option<&OsStr>) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    let meta = path.metadata().ok()?;
    Some(Identity { node: (meta.dev(), meta.ino()), name: name.map(OsStr::to_owned) })
}

#[cfg(not(unix))]
fn of_path(path: &Path, name: Option<&OsStr>) -> Option<Identity> {
    Some(Identity { node: path.canonicalize().ok()?, name: name.map(OsStr::to_owned) })
}

/// A file to which the shell has redirected standard input or output.
#[cfg(unix)]
fn of_stream(stream: &impl std::os::fd::AsFd) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    let file = std::fs::File::from(stream.as_fd().try_clone_to_owned().ok()?);
    let meta = file.metadata().ok()?;
    meta.is_file().then(|| Identity { node: (meta.dev(), meta.ino()), name: None })
}

#[cfg(not(unix))]
fn of_stream<T>(_: &T) -> Option<Identity> {
    None
}
