//! What waits until it is whole, in a file that nobody sees, in the folder for such files.

use std::fs::File;
use std::io::{self, Seek, Write};

use postform::internals::terminal::escaped;

/// A file without a name, to be written and then read. Its errors name the folder.
pub struct Spool(File);

impl Spool {
    /// An empty one.
    ///
    /// # Errors
    /// The folder is not there, or takes no file.
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

/// The kind stays: an interrupted call is made again.
fn named(error: io::Error) -> io::Error {
    let folder = escaped(&std::env::temp_dir().to_string_lossy());
    io::Error::new(error.kind(), format!("a temporary file in {folder} (TMPDIR): {error}"))
}
