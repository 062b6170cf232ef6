//! A file without a name until it is complete. If the process ends before the file is complete, no part of the file
//! remains.

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
    /// Creates a file that will become `path`, with the permissions of the file that it replaces.
    ///
    /// # Errors
    /// The folder does not exist, or no file can be created in it.
    pub fn beside(path: PathBuf, mode: Option<Permissions>) -> io::Result<Unnamed> {
        let place = folder(&path);
        let name = escaped(&place.to_string_lossy());
        if !place.is_dir() {
            let message = format!("there is no folder {name}\n  help: make the folder first");
            return Err(io::Error::new(io::ErrorKind::NotFound, message));
        }
        let file = tempfile::tempfile_in(place)
            .map_err(|error| io::Error::new(error.kind(), format!("can't make a file in {name}: {error}")))?;
        if let Some(mode) = &mode {
            // the new file keeps the permissions of the old one
            file.set_permissions(mode.clone())?;
        }
        Ok(Unnamed { file, path, mode })
    }

    /// Sets another path in the same folder for the finished file.
    pub fn renamed(self, path: PathBuf, mode: Option<Permissions>) -> io::Result<Unnamed> {
        if let Some(mode) = &mode {
            self.file.set_permissions(mode.clone())?;
        }
        Ok(Unnamed { path, mode, ..self })
    }

    /// The file, for writing.
    pub fn file(&mut self) -> &mut File {
        &mut self.file
    }

    /// Makes the file visible under its name, and replaces a file with the same name.
    ///
    /// # Errors
    /// As reported by the system; the old file is unchanged.
    pub fn replace(mut self) -> io::Result<()> {
        if self.appears()? {
            return Ok(());
        }
        let path = self.hidden()?;
        path.persist(&self.path).map_err(|error| error.error)
    }

    /// Makes the file visible under its name, if no file has that name.
    ///
    /// # Errors
    /// `AlreadyExists`: a file has this name.
    pub fn create(mut self) -> io::Result<()> {
        if self.appears()? {
            return Ok(());
        }
        let path = self.hidden()?;
        path.persist_noclobber(&self.path).map_err(|error| error.error)
    }

    /// Gives the file its name if no other file has this name. Otherwise the file stays unnamed.
    fn appears(&self) -> io::Result<bool> {
        self.file.sync_all()?; // the contents must be on the disk before the name
        Ok(link(&self.file, &self.path).is_ok())
    }

    /// Gives the file a temporary hidden name for the rename.
    fn hidden(&mut self) -> io::Result<TempPath> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".postform-");
        let place = folder(&self.path);
        if let Ok(linked) = builder.make_in(place, |name| link(&self.file, name)) {
            return Ok(linked.into_temp_path());
        }
        // the contents are copied if the system has no unnamed files
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // the file gets the permissions of any new file; the umask still applies
            builder.permissions(Permissions::from_mode(0o666));
        }
        // only the kind of the error is returned, because the whole error contains the hidden name
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

/// Links the file to a name that must be free.
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
