//! Output that is kept in an unnamed temporary file until it is complete.

use std::fs::File;
use std::io::{self, Seek, Write};

use postform::internals::terminal::escaped;

/// An unnamed file, which is written and then read. Errors of this file contain the name of its folder.
pub struct Spool(File);

impl Spool {
    /// An empty spool.
    ///
    /// # Errors
    /// The folder does not exist, or no file can be created in it.
    pub fn new() -> io::Result<Spool> {
        tempfile::tempfile().map(Spool).map_err(named)
    }

    /// The spooled file, to be read from its beginning.
    pub fn into_file(mut self) -> io::Result<File> {
        self.0.rewind().map_err(named)?;
        Ok(self.0)
    }
}

impl Write for Spool {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes).map_err(named)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(named)
    }
}

/// Adds the folder to an error. The kind of the error stays the same, because an interrupted call is repeated.
fn named(error: io::Error) -> io::Error {
    let folder = escaped(&std::env::temp_dir().to_string_lossy());
    io::Error::new(error.kind(), format!("a temporary file in {folder} (TMPDIR): {error}"))
}
