//! Where programs go. A program appears under its name, or on standard output, only when it is complete.

use std::fs::{self, File};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use postform::diag::escaped;

use super::Ending;
use super::files::io_message;

/// A file that is being written and not there yet.
pub enum Target {
    /// Beside its target, to be renamed.
    Beside(NamedTempFile, PathBuf),
    /// A device, a pipe or standard output: spooled, then copied.
    Spooled(File, Option<PathBuf>),
    /// Standard output as it comes.
    Stream,
}

impl Target {
    /// Prepares the output `path`; `-` is standard output.
    ///
    /// # Errors
    /// A message: the file can't be made.
    pub fn open(path: &Path, stream: bool) -> Result<Target, String> {
        let fail = |error: io::Error| io_message("write", path, &error);
        if path == Path::new("-") {
            if stream {
                return Ok(Target::Stream);
            }
            return Ok(Target::Spooled(tempfile::tempfile().map_err(fail)?, None));
        }
        // a link is followed; a device or pipe must never be replaced by a file
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        match fs::metadata(&path) {
            Ok(meta) if meta.is_dir() => Err(fail(io::Error::from(io::ErrorKind::IsADirectory))),
            Ok(meta) if !meta.is_file() => Ok(Target::Spooled(tempfile::tempfile().map_err(fail)?, Some(path))),
            meta => {
                let mode = meta.ok().map(|meta| meta.permissions());
                if mode.as_ref().is_some_and(fs::Permissions::readonly) {
                    return Err(format!("error: can't write {}: it is read-only", escaped(&path.to_string_lossy())));
                }
                let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
                if !folder.is_dir() {
                    let (path, folder) = (escaped(&path.to_string_lossy()), escaped(&folder.to_string_lossy()));
                    return Err(format!(
                        "error: can't write {path}: there is no folder {folder}\n  help: make it first"
                    ));
                }
                let mut builder = tempfile::Builder::new();
                builder.prefix(".postform-");
                #[cfg(unix)]
                {
                    use std::os::unix::fs::PermissionsExt;
                    // what any new file gets; the umask still applies
                    builder.permissions(fs::Permissions::from_mode(0o666));
                }
                // the kind alone: the whole error names the file beside the target
                let named = |error: io::Error| fail(error.kind().into());
                let file = builder.tempfile_in(folder).map_err(named)?;
                if let Some(mode) = mode {
                    // a file that is replaced keeps who may read and run it
                    file.as_file().set_permissions(mode).map_err(fail)?;
                }
                Ok(Target::Beside(file, path))
            }
        }
    }

    /// Writes a part.
    ///
    /// # Errors
    /// As the system says; a closed pipe among them.
    pub fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        match self {
            Target::Beside(file, _) => file.write_all(bytes),
            Target::Spooled(file, _) => file.write_all(bytes),
            Target::Stream => io::stdout().write_all(bytes),
        }
    }

    /// What was written so far, to be read from its beginning; `None` where it is gone.
    ///
    /// # Errors
    /// As the system says.
    pub fn written(&mut self) -> io::Result<Option<File>> {
        let mut file = match self {
            Target::Beside(file, _) => file.reopen()?,
            Target::Spooled(file, _) => file.try_clone()?,
            Target::Stream => return Ok(None),
        };
        file.rewind()?;
        Ok(Some(file))
    }

    /// The program is complete: lets it appear.
    ///
    /// # Errors
    /// As the system says; nothing of the program is then under the target's name.
    pub fn complete(self) -> io::Result<()> {
        match self {
            Target::Beside(mut file, path) => {
                file.flush()?;
                file.as_file().sync_all()?; // the name must not come before the contents
                file.persist(path).map_err(|error| error.error)?;
                Ok(())
            }
            Target::Spooled(mut file, path) => {
                file.rewind()?;
                match path {
                    None => {
                        let mut out = io::stdout().lock();
                        io::copy(&mut file, &mut out)?;
                        out.flush()
                    }
                    Some(path) => {
                        let mut out = File::options().write(true).open(path)?;
                        io::copy(&mut file, &mut out)?;
                        out.flush()
                    }
                }
            }
            Target::Stream => io::stdout().flush(),
        }
    }
}

/// Writes a file, whole or not at all.
///
/// # Errors
/// A message; what was there is there still.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let fail = |error| io_message("write", path, &error);
    let mut target = Target::open(path, false)?;
    target.write(bytes).map_err(fail)?;
    target.complete().map_err(fail)
}

/// Writes to standard output; a closed pipe is no error.
pub fn standard_output(write: impl FnOnce(&mut io::StdoutLock) -> io::Result<()>) -> Result<(), String> {
    let mut out = io::stdout().lock();
    match write(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(io_message("write", Path::new("standard output"), &error))
        }
        _ => Ok(()),
    }
}

/// Writes to standard output and ends the command with it.
pub fn shown(write: impl FnOnce(&mut io::StdoutLock) -> io::Result<()>) -> Result<Ending, String> {
    standard_output(write).map(|()| Ending::Clean)
}
