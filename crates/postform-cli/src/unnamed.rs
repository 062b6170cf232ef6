//! A file without a name until it is complete: whatever ends this process before, nothing of it is left behind.

use std::fs::{File, Permissions};
use std::io::{self, Seek};
use std::path::{Path, PathBuf};

use postform::internals::terminal::escaped;
use tempfile::TempPath;

use super::destination::folder;

/// A file in the folder of its path.
pub struct Unnamed {
    file: File,
    path: PathBuf,
    mode: Option<Permissions>,
}

impl Unnamed {
    /// Makes a file that is to become `path`, with the permissions of the file that it replaces.
    ///
    /// # Errors
    /// The folder is not there, or takes no file.
    pub fn beside(path: PathBuf, mode: Option<Permissions>) -> io::Result<Unnamed> {
        let place = folder(&path);
        let name = escaped(&place.to_string_lossy());
        if !place.is_dir() {
            let message = format!("there is no folder {name}\n  help: make it first");
            return Err(io::Error::new(io::ErrorKind::NotFound, message));
        }
        let file = tempfile::tempfile_in(place)
            .map_err(|error| io::Error::new(error.kind(), format!("no file can be made in {name}: {error}")))?;
        if let Some(mode) = &mode {
            // a file that is replaced keeps who may read and run it
            file.set_permissions(mode.clone())?;
        }
        Ok(Unnamed { file, path, mode })
    }

    /// Another path of the same folder, which the file is to become.
    pub fn renamed(self, path: PathBuf, mode: Option<Permissions>) -> io::Result<Unnamed> {
        if let Some(mode) = &mode {
            self.file.set_permissions(mode.clone())?;
        }
        Ok(Unnamed { path, mode, ..self })
    }

    /// What is written so far and what is still to come.
    pub fn file(&mut self) -> &mut File {
        &mut self.file
    }

    /// Lets the file appear, in the place of what has its name.
    ///
    /// # Errors
    /// As the system says; what was there is there still.
    pub fn replace(mut self) -> io::Result<()> {
        if self.appears()? {
            return Ok(());
        }
        let path = self.hidden()?;
        path.persist(&self.path).map_err(|error| error.error)
    }

    /// Lets the file appear where nothing has its name.
    ///
    /// # Errors
    /// `AlreadyExists`: something has.
    pub fn create(mut self) -> io::Result<()> {
        if self.appears()? {
            return Ok(());
        }
        let path = self.hidden()?;
        path.persist_noclobber(&self.path).map_err(|error| error.error)
    }

    /// Gives the file its name if nothing has that; otherwise the file never had another.
    fn appears(&self) -> io::Result<bool> {
        self.file.sync_all()?; // the name must not come before the contents
        Ok(link(&self.file, &self.path).is_ok())
    }

    /// Under a name that nobody knows, for as long as a rename takes.
    fn hidden(&mut self) -> io::Result<TempPath> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".postform-");
        let place = folder(&self.path);
        if let Ok(linked) = builder.make_in(place, |name| link(&self.file, name)) {
            return Ok(linked.into_temp_path());
        }
        // where a file must have a name from its beginning, the contents are copied
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // what any new file gets; the umask still applies
            builder.permissions(Permissions::from_mode(0o666));
        }
        // the kind alone: the whole error tells the hidden name
        let mut copy = builder.tempfile_in(place).map_err(|error| io::Error::from(error.kind()))?;
        self.file.rewind()?;
        io::copy(&mut self.file, copy.as_file_mut())?;
        if let Some(mode) = &self.mode {
            copy.as_file().set_permissions(mode.clone())?;
        }
        copy.as_file().sync_all()?;
        Ok(copy.into_temp_path())
    }
}

/// Gives the file a name that nothing has.
#[cfg(target_os = "linux")]
fn link(file: &File, name: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    use std::os::fd::AsRawFd;
    let unnamed = format!("/proc/self/fd/{}", file.as_raw_fd());
    Ok(linkat(CWD, unnamed, CWD, name, AtFlags::SYMLINK_FOLLOW)?)
}

#[cfg(not(target_os = "linux"))]
fn link(_: &File, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
