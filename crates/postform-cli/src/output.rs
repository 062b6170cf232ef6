//! Outputs. A program appears under its name, or on standard output, only after it is complete.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use flate2::write::GzEncoder;
use postform::internals::terminal::{escaped, steers};

use super::Ending;
use super::destination::{Destination, destination};
use super::files::{io_message, output_name};
use super::inputs;
use super::packed::{pack, packing, unpacked_name};
use super::spool::Spool;
use super::unnamed::Unnamed;

/// An output that is being written and is not visible yet.
pub enum Target {
    /// An unnamed file in the folder of the target. The file gets the target's name at the end.
    Beside(Unnamed),
    /// A device, a pipe or standard output: spooled, then copied.
    Spooled(Spool, Option<PathBuf>),
    /// Standard output, written without a spool.
    Stream,
    /// An output of another kind that is compressed, because the name ends with `.gz`.
    Packed(Box<(Target, GzEncoder<Vec<u8>>)>),
}

impl Target {
    /// Prepares the output `path`; `-` is standard output.
    ///
    /// # Errors
    /// A message: the file can't be created, or it is also an input.
    pub fn open(path: &Path, stream: bool) -> Result<Target, String> {
        if inputs::holds(path) {
            return Err(format!("error: {} is an input: choose another output", output_name(path)));
        }
        let target = Target::place(path, stream)?;
        Ok(match unpacked_name(path) {
            Some(_) => Target::Packed(Box::new((target, packing()))),
            None => target,
        })
    }

    /// Prepares the output without a check of the inputs, for a file that is read and written.
    fn place(path: &Path, stream: bool) -> Result<Target, String> {
        let fail = |error: io::Error| io_message("write", path, &error);
        if path == Path::new("-") {
            if stream {
                return Ok(Target::Stream);
            }
            return Ok(Target::Spooled(Spool::new().map_err(fail)?, None));
        }
        let Destination { path: to, stays } = destination(path).map_err(fail)?;
        if stays {
            return Ok(Target::Spooled(Spool::new().map_err(fail)?, Some(to)));
        }
        let meta = fs::metadata(&to).ok();
        if meta.as_ref().is_some_and(fs::Metadata::is_dir) {
            return Err(fail(io::Error::from(io::ErrorKind::IsADirectory)));
        }
        let mode = meta.map(|meta| meta.permissions());
        if mode.as_ref().is_some_and(fs::Permissions::readonly) {
            return Err(format!("error: can't write {}: it is read-only", escaped(&to.to_string_lossy())));
        }
        Ok(Target::Beside(Unnamed::beside(to, mode).map_err(fail)?))
    }

    /// Prepares an output in a folder; the output gets its name when it is complete: see [`Target::named`]. `name` is
    /// the final name of the output, if already known; if this name ends with `.gz`, the output is compressed.
    ///
    /// # Errors
    /// As [`Target::open`].
    pub fn open_in(folder: &Path, name: Option<&str>) -> Result<Target, String> {
        let unnamed = Unnamed::beside(folder.join("program"), None);
        let target = Target::Beside(unnamed.map_err(|error| io_message("write", folder, &error))?);
        Ok(match name.map(Path::new).and_then(unpacked_name) {
            Some(_) => Target::Packed(Box::new((target, packing()))),
            None => target,
        })
    }

    /// Sets the name of an output in a folder.
    ///
    /// # Errors
    /// A message: the existing file with that name must not be replaced.
    pub fn named(self, path: &Path) -> Result<Target, String> {
        let unnamed = match self {
            Target::Beside(unnamed) => unnamed,
            Target::Packed(packed) => {
                let (target, encoder) = *packed;
                return Ok(Target::Packed(Box::new((target.named(path)?, encoder))));
            }
            other => return Ok(other),
        };
        if inputs::holds(path) {
            return Err(format!("error: {} is an input: choose another folder", output_name(path)));
        }
        // a link must not be replaced
        let mode = fs::symlink_metadata(path).ok().map(|meta| (meta.is_file(), meta.permissions()));
        if mode.as_ref().is_some_and(|(is_file, mode)| !is_file || mode.readonly()) {
            return Err(format!("error: can't write {}: it is not a regular file", escaped(&path.to_string_lossy())));
        }
        let renamed = unnamed.renamed(path.to_path_buf(), mode.map(|(_, mode)| mode));
        Ok(Target::Beside(renamed.map_err(|error| io_message("write", path, &error))?))
    }

    /// Writes a part.
    ///
    /// # Errors
    /// As reported by the system, including a closed pipe.
    pub fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        match self {
            Target::Beside(unnamed) => unnamed.file().write_all(bytes),
            Target::Spooled(spool, _) => spool.write_all(bytes),
            Target::Stream => io::stdout().write_all(bytes),
            Target::Packed(packed) => {
                let (target, encoder) = &mut **packed;
                pack(encoder, bytes, |bytes| target.write(bytes))
            }
        }
    }

    /// Makes the complete program visible under its name.
    ///
    /// # Errors
    /// As reported by the system; after an error, no part of the program is under the target's name.
    pub fn complete(self) -> io::Result<()> {
        match self {
            Target::Beside(unnamed) => unnamed.replace(),
            Target::Spooled(spool, path) => {
                let mut file = spool.into_file()?;
                match path {
                    None => {
                        let mut out = io::stdout().lock();
                        io::copy(&mut file, &mut out)?;
                        out.flush()
                    }
                    Some(path) => {
                        let mut out = opened(&path)?;
                        io::copy(&mut file, &mut out)?;
                        out.flush()
                    }
                }
            }
            Target::Stream => io::stdout().flush(),
            Target::Packed(packed) => {
                let (mut target, encoder) = *packed;
                target.write(&encoder.finish()?)?;
                target.complete()
            }
        }
    }
}

/// Opens an output that is written to but not replaced. For the standard output or error of this process, the existing
/// stream is used, so that the text follows the earlier output.
fn opened(path: &Path) -> io::Result<File> {
    let is = fs::metadata(path)?;
    #[cfg(unix)]
    {
        use std::os::fd::AsFd;
        use std::os::unix::fs::MetadataExt;
        let (out, err) = (io::stdout(), io::stderr());
        for stream in [out.as_fd(), err.as_fd()] {
            let own = File::from(stream.try_clone_to_owned()?);
            let meta = own.metadata()?;
            if (meta.dev(), meta.ino()) == (is.dev(), is.ino()) {
                return Ok(own);
            }
        }
    }
    // append to the existing text
    File::options().write(true).append(is.is_file()).open(path)
}

/// Writes a file completely or not at all.
///
/// # Errors
/// A message; the old contents are unchanged.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), String> {
    whole(Target::place(path, false)?, path, bytes)
}

/// Writes an output in one piece. `path`: the path of the output. A closed pipe at standard output is not an error.
///
/// # Errors
/// A message: the output can't be written.
pub fn whole(mut target: Target, path: &Path, bytes: &[u8]) -> Result<(), String> {
    match target.write(bytes).and_then(|()| target.complete()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe && path == Path::new("-") => Ok(()),
        done => done.map_err(|error| io_message("write", path, &error)),
    }
}

/// Writes a file that must not exist yet.
///
/// # Errors
/// `AlreadyExists`, or as reported by the system; no file is created.
pub fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut target = Unnamed::beside(path.to_path_buf(), None)?;
    target.file().write_all(bytes)?;
    target.create()
}

/// A JSON document that is safe for terminals: control characters are escaped and can be read back.
pub fn json(document: &serde_json::Value) -> String {
    safe(&format!("{document:#}"))
}

/// A JSON document on one line. The document is safe for terminals, like the document of `json`.
pub fn json_line(document: &serde_json::Value) -> String {
    safe(&document.to_string())
}

fn safe(document: &str) -> String {
    let mut text = String::with_capacity(document.len() + 1);
    for c in document.chars() {
        // line ends belong to the layout; those in strings are already escaped
        if c != '\n' && steers(c) {
            text += &format!("\\u{:04x}", u32::from(c));
        } else {
            text.push(c);
        }
    }
    text.push('\n');
    text
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

/// Writes to standard output as the last step of a command.
pub fn shown(write: impl FnOnce(&mut io::StdoutLock) -> io::Result<()>) -> Result<Ending, String> {
    standard_output(write).map(|()| Ending::Clean)
}
