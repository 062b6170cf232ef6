//! Reads the zip archive of a document. The unpacked size is limited, because an archive of a few kilobytes can unpack to terabytes.

use std::io::{BufRead, BufReader, Read, Seek};

use zip::ZipArchive;
use zip::result::ZipError;

use crate::diag::{Code, Diag};
use crate::toolpath::ReadError;

/// Maximum size of `Document.xml` in bytes. In a document with a thousand objects, this file has three million bytes.
pub(super) const LARGEST_DOCUMENT: u64 = 64 << 20;
/// Maximum size of one operation's path in bytes. The size is enough for about twenty million moves.
const LARGEST_PATH: u64 = 1 << 30;

/// Maximum ratio of unpacked to packed size. The deflate format allows at most 1,032, and paths have much smaller ratios.
const MOST_TIMES: u64 = 1000;
/// An unpacked size up to this number of bytes is always accepted.
const ALWAYS: u64 = 1 << 20;

/// The archive of a document.
pub(super) struct Archive<R> {
    zip: ZipArchive<R>,
}

impl<R: Read + Seek> Archive<R> {
    /// Opens an archive and reads its directory.
    pub fn open(input: R) -> Result<Archive<R>, ReadError> {
        match ZipArchive::new(input) {
            Ok(zip) => Ok(Archive { zip }),
            Err(error) => Err(refused("the file", error)),
        }
    }

    /// Reads a whole file of the archive as text.
    pub fn whole(&mut self, name: &str, most: u64) -> Result<String, ReadError> {
        let mut text = String::new();
        match self.bounded(name, most)?.read_to_string(&mut text) {
            Ok(_) => Ok(text),
            Err(error) => Err(unpacked(name, error)),
        }
    }

    /// Opens the path of an operation for reading line by line. `None`: the operation has no path, and therefore no moves.
    pub fn member(&mut self, name: &Option<String>) -> Result<Option<impl BufRead + use<'_, R>>, ReadError> {
        match name {
            Some(name) => Ok(Some(BufReader::new(self.bounded(name, LARGEST_PATH)?))),
            None => Ok(None),
        }
    }

    fn bounded(&mut self, name: &str, most: u64) -> Result<impl Read + use<'_, R>, ReadError> {
        match self.zip.by_name(name) {
            Ok(member) => {
                let most = most.min(member.compressed_size().saturating_mul(MOST_TIMES).max(ALWAYS));
                Ok(Bounded { inner: member, left: most })
            }
            Err(error) => Err(refused(name, error)),
        }
    }
}

/// A reader that fails if a file has more data than allowed.
struct Bounded<R> {
    inner: R,
    left: u64,
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.inner.read(buffer)?;
        match self.left.checked_sub(count as u64) {
            Some(left) => self.left = left,
            None => {
                return Err(std::io::Error::new(std::io::ErrorKind::FileTooLarge, "its unpacked size is too large"));
            }
        }
        Ok(count)
    }
}

/// The error for a file of the archive that can't be opened.
fn refused(what: &str, error: ZipError) -> ReadError {
    match error {
        ZipError::Io(error) if is_of_system(&error) => ReadError::Io(error),
        ZipError::FileNotFound => ReadError::Job(no_document(format!("the archive has no `{what}`"))),
        error => ReadError::Job(no_document(format!("{what} can't be unpacked: {error}"))),
    }
}

/// The error for a file of the archive that can't be read to its end.
pub(super) fn unpacked(name: &str, error: std::io::Error) -> ReadError {
    if is_of_system(&error) {
        return ReadError::Io(error);
    }
    ReadError::Job(no_document(format!("`{name}` can't be unpacked: {error}")))
}

/// Whether the operating system reported the error. Any other error means that the archive is damaged.
fn is_of_system(error: &std::io::Error) -> bool {
    error.raw_os_error().is_some()
}

fn no_document(message: String) -> Box<Diag> {
    let help = "give a document that FreeCAD has saved (.FCStd); open the document in FreeCAD and save it again";
    Box::new(Diag::new(Code::PD001, message).help(help))
}
