//! Where programs go. A program appears under its name, or on standard output, only when it is complete.

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

/// A file that is being written and not there yet.
pub enum Target {
    /// A file without a name in the folder of its target, to appear there.
    Beside(Unnamed),
    /// A device, a pipe or standard output: spooled, then copied.
    Spooled(Spool, Option<PathBuf>),
    /// Standard output, written as text comes.
    Stream,
    /// One of these, by a name that ends with `.gz`.
    Packed(Box<(Target, GzEncoder<Vec<u8>>)>),
}

impl Target {
    /// Prepares the output `path`; `-` is standard output.
    ///
    /// # Errors
    /// A message: the file can't be made, or it is one that was read.
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

    /// The same for a file that is read and written.
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

    /// Prepares an output in a folder, which gets its name when it is complete: see [`Target::named`]. `name` is that name where it is
    /// known before: one that ends with `.gz` is compressed.
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

    /// Gives an output of a folder its name.
    ///
    /// # Errors
    /// A message: what has that name must not be replaced.
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
        // a link is no file that may be replaced
        let mode = fs::symlink_metadata(path).ok().map(|meta| (meta.is_file(), meta.permissions()));
        if mode.as_ref().is_some_and(|(is_file, mode)| !is_file || mode.readonly()) {
            return Err(format!(
                "error: can't write {}: it is no file that may be replaced",
                escaped(&path.to_string_lossy())
            ));
        }
        let renamed = unnamed.renamed(path.to_path_buf(), mode.map(|(_, mode)| mode));
        Ok(Target::Beside(renamed.map_err(|error| io_message("write", path, &error))?))
    }

    /// Writes a part.
    ///
    /// # Errors
    /// As the system says; a closed pipe among them.
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

    /// The program is complete: lets it appear.
    ///
    /// # Errors
    /// As the system says; nothing of the program is then under the target's name.
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

/// What is written and not replaced. Where it is this process' own standard output or error it is that stream, so that the
/// text comes after what was written to it.
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
    // after what is there
    File::options().write(true).append(is.is_file()).open(path)
}

/// Writes a file, whole or not at all.
///
/// # Errors
/// A message; what was there is there still.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let fail = |error| io_message("write", path, &error);
    let mut target = Target::place(path, false)?;
    target.write(bytes).map_err(fail)?;
    target.complete().map_err(fail)
}

/// Writes a file that must not be there yet.
///
/// # Errors
/// `AlreadyExists`, or as the system says; nothing is then made.
pub fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut target = Unnamed::beside(path.to_path_buf(), None)?;
    target.file().write_all(bytes)?;
    target.create()
}

/// A JSON document for people's terminals, too: what would steer one is escaped, and reads back as it was.
pub fn json(document: &serde_json::Value) -> String {
    safe(&format!("{document:#}"))
}

/// The same on one line.
pub fn json_line(document: &serde_json::Value) -> String {
    safe(&document.to_string())
}

fn safe(document: &str) -> String {
    let mut text = String::with_capacity(document.len() + 1);
    for c in document.chars() {
        // line ends are the layout: in strings they are escaped already
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

/// Writes to standard output and ends the command with it.
pub fn shown(write: impl FnOnce(&mut io::StdoutLock) -> io::Result<()>) -> Result<Ending, String> {
    standard_output(write).map(|()| Ending::Clean)
}
