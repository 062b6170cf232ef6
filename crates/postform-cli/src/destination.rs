//! Where the name of an output leads.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Where an output goes: links are followed.
pub struct Destination {
    /// The last name.
    pub path: PathBuf,
    /// A device, a pipe or a file that a process has open, as /dev/stdout: it is written, and no file takes its place.
    pub stays: bool,
}

/// The folder that a file is in.
pub fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Where a name leads, also by a link that leads to nothing yet.
///
/// # Errors
/// As the system says; links that lead in a circle among them.
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

/// Is it the name of an open file, as /dev/fd/3 and /proc/self/fd/1 are?
fn is_open(path: &Path) -> bool {
    let place = folder(path).canonicalize().unwrap_or_default();
    place.ends_with("fd") && (place.starts_with("/proc") || place.starts_with("/dev"))
}
