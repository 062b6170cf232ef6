//! Resolves the name of an output.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The destination of an output, with links resolved.
pub struct Destination {
    /// The last name in the chain of links.
    pub path: PathBuf,
    /// The target is a device, a pipe or a file that a process has open, such as /dev/stdout. postform writes to such a
    /// target, and does not replace the target by a file.
    pub stays: bool,
}

/// The folder of a file.
pub fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Resolves a name, also through a link whose target does not exist yet.
///
/// # Errors
/// As reported by the system, including circular links.
pub fn destination(path: &Path) -> io::Result<Destination> {
    match fs::metadata(path) {
        Ok(meta) if meta.is_file() || meta.is_dir() => {}
        Ok(_) => return Ok(Destination { path: path.to_path_buf(), stays: true }),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        Err(error) => return Err(error),
    }
    match fs::read_link(path) {
        Ok(_) if is_open(path) => Ok(Destination { path: path.to_path_buf(), stays: true }),
        Ok(next) => destination(&folder(path).join(next)),
        Err(_) => Ok(Destination { path: path.to_path_buf(), stays: false }),
    }
}

/// Whether the path is the name of an open file, such as /dev/fd/3 and /proc/self/fd/1.
fn is_open(path: &Path) -> bool {
    let place = folder(path).canonicalize().unwrap_or_default();
    place.ends_with("fd") && (place.starts_with("/proc") || place.starts_with("/dev"))
}
