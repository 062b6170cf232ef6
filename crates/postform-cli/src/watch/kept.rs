//! The stored port and token of a form's page. With the port and the token, an open page connects again after a restart
//! of postform.
//!
//! The port and the token are stored in a file that only this user can read, in the system's folder for private files
//! of a user. The folder is `XDG_RUNTIME_DIR` on Linux, and the user's folder for temporary files on macOS and Windows.
//! If the folder does not exist, nothing is stored.

use std::ffi::OsString;
use std::fs::{self, DirBuilder, OpenOptions};
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The file with the port and token of a form.
pub struct Kept {
    path: PathBuf,
}

impl Kept {
    /// The file for a form; `None`: there is no folder for it, or the form does not exist.
    pub fn of(form: &Path) -> Option<Kept> {
        let mut hasher = DefaultHasher::new();
        form.canonicalize().ok()?.hash(&mut hasher);
        Some(Kept { path: folder()?.join("postform").join(format!("{:016x}", hasher.finish())) })
    }

    /// Port and token of the last run. A file that other users can read is not trusted.
    pub fn read(&self) -> Option<(u16, String)> {
        if !is_private(&self.path) {
            return None;
        }
        let text = fs::read_to_string(&self.path).ok()?;
        let (port, token) = text.trim_end().split_once(' ')?;
        let is_token = token.len() == 32 && token.bytes().all(|byte| byte.is_ascii_hexdigit());
        Some((port.parse().ok().filter(|&port| port > 0)?, is_token.then(|| token.to_owned())?))
    }

    /// Stores port and token. If port and token can't be stored, the page has another address after the next start.
    pub fn write(&self, port: u16, token: &str) {
        let (mut folder, mut file) = (DirBuilder::new(), OpenOptions::new());
        #[cfg(unix)]
        {
            use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
            folder.mode(0o700);
            file.mode(0o600);
        }
        _ = self.path.parent().map(|parent| folder.recursive(true).create(parent));
        _ = fs::remove_file(&self.path);
        if let Ok(mut file) = file.write(true).create_new(true).open(&self.path) {
            _ = writeln!(file, "{port} {token}");
        }
    }
}

/// The folder of this user for files that last only for a session.
fn folder() -> Option<PathBuf> {
    let named = std::env::var_os("XDG_RUNTIME_DIR").filter(|value: &OsString| Path::new(value).is_absolute());
    let own = || cfg!(any(windows, target_os = "macos")).then(std::env::temp_dir);
    named.map(PathBuf::from).or_else(own)
}

#[cfg(unix)]
fn is_private(path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    fs::symlink_metadata(path).is_ok_and(|meta| meta.is_file() && meta.mode() & 0o077 == 0)
}

#[cfg(not(unix))]
fn is_private(path: &Path) -> bool {
    path.is_file()
}
