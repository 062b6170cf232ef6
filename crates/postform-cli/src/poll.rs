//! Checks several files repeatedly for changes.
//!
//! Checking a few files five times per second costs almost nothing and works on network drives. The check also detects
//! the change if an editor writes a second file and renames it.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use super::Ending;
use super::say::message;

/// Pause between two checks.
const PAUSE: Duration = Duration::from_millis(150);

/// The time of the last change of a file, and its length; `None`: the file does not exist.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> Stamp {
    let meta = fs::metadata(path).ok()?;
    Some((meta.modified().ok()?, meta.len()))
}

/// The state of files at the last check.
pub struct Watched(Vec<(PathBuf, Stamp)>);

impl Watched {
    /// The current state of files.
    pub fn new(paths: impl IntoIterator<Item = PathBuf>) -> Watched {
        Watched(paths.into_iter().map(|path| (path.clone(), stamp(&path))).collect())
    }

    fn look(&self) -> Watched {
        Watched::new(self.0.iter().map(|(path, _)| path.clone()))
    }

    /// Waits until a file has changed and no file changes any more.
    pub fn wait(&self) {
        self.wait_while(|| true);
    }

    /// Like `wait`, but ends as soon as `watches` returns `false`, because other files must be watched. The result is
    /// then `false`.
    pub fn wait_while(&self, watches: impl Fn() -> bool) -> bool {
        loop {
            sleep(PAUSE);
            let mut seen = self.look();
            if seen.0 == self.0 {
                if !watches() {
                    return false;
                }
                continue;
            }
            // a file that is written in parts must be complete first
            loop {
                sleep(PAUSE / 3);
                let next = seen.look();
                if next.0 == seen.0 {
                    return true;
                }
                seen = next;
            }
        }
    }
}

/// Runs a command again whenever one of its files changes, until the user ends it. Errors are printed, and the command waits
/// for a change.
pub fn repeat(
    paths: impl Fn() -> Vec<PathBuf>,
    mut command: impl FnMut() -> Result<Ending, String>,
) -> Result<Ending, String> {
    if paths().iter().any(|path| path == Path::new("-")) {
        return Err("error: --watch needs files: standard input (-) can't be read again".into());
    }
    loop {
        let watched = Watched::new(paths());
        if let Err(text) = command() {
            message(&text);
        }
        message("(waiting for changes; Ctrl-C ends it)");
        watched.wait();
    }
}
