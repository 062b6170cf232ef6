//! Files looked at again and again: whether one was changed.
//!
//! Asking for a few files five times a second costs nothing, works on network drives, and sees what editors do that write beside a
//! file and rename.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use super::Ending;
use super::say::message;

/// Between two looks.
const PAUSE: Duration = Duration::from_millis(150);

/// When a file was written, and its length; `None`: it is not there.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> Stamp {
    let meta = fs::metadata(path).ok()?;
    Some((meta.modified().ok()?, meta.len()))
}

/// How files were when they were looked at.
pub struct Watched(Vec<(PathBuf, Stamp)>);

impl Watched {
    /// Files as they are now.
    pub fn new(paths: impl IntoIterator<Item = PathBuf>) -> Watched {
        Watched(paths.into_iter().map(|path| (path.clone(), stamp(&path))).collect())
    }

    fn look(&self) -> Watched {
        Watched::new(self.0.iter().map(|(path, _)| path.clone()))
    }

    /// Waits until one was changed and none changes any more.
    pub fn wait(&self) {
        self.wait_while(|| true);
    }

    /// Waits so as long as the files are those to be watched. `false`: they are others now, and none was changed.
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
            // who writes in parts is left to end
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

/// Does a command again whenever one of its files changes, until it is ended. What is wrong is said, and waited for to be fixed.
pub fn repeat(
    paths: impl Fn() -> Vec<PathBuf>,
    mut command: impl FnMut() -> Result<Ending, String>,
) -> Result<Ending, String> {
    if paths().iter().any(|path| path == Path::new("-")) {
        return Err("error: --watch reads files that can be read again: - is none".into());
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
