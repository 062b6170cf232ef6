//! A program that is read on one thread while another thread still prints it.

use std::io::{self, Read, Seek, SeekFrom};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// The text of a program up to the part that was printed last.
#[derive(Default)]
pub struct Growing {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    text: Vec<u8>,
    end: Option<End>,
}

#[derive(Clone, Copy, PartialEq)]
enum End {
    /// The text is the whole program.
    Whole,
    /// The text is incomplete: the program is not needed, or can't be printed.
    Dropped,
}

/// Adds parts to the text. If a writer is dropped before [`finish`](Writer::finish), readers get an error.
pub struct Writer<'a>(&'a Growing);

/// Reads the text and waits for the parts that are not printed yet.
pub struct Reader<'a> {
    of: &'a Growing,
    at: u64,
}

impl Growing {
    /// The writer of the text. Each text has only one writer.
    pub fn writer(&self) -> Writer<'_> {
        Writer(self)
    }

    /// A reader from the beginning of the text.
    pub fn reader(&self) -> Reader<'_> {
        Reader { of: self, at: 0 }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the text has more than `length` bytes or has ended.
    fn longer_than(&self, length: u64) -> io::Result<MutexGuard<'_, State>> {
        let is_short = |state: &mut State| state.end.is_none() && state.text.len() as u64 <= length;
        let state = self.changed.wait_while(self.lock(), is_short).unwrap_or_else(PoisonError::into_inner);
        match state.end {
            Some(End::Dropped) => Err(io::Error::other("the program is not printed to its end")),
            _ => Ok(state),
        }
    }
}

impl Writer<'_> {
    /// Adds a part to the text.
    pub fn push(&self, part: &[u8]) {
        self.0.lock().text.extend_from_slice(part);
        self.0.changed.notify_all();
    }

    /// Ends the text: it is the whole program.
    pub fn finish(self) {
        self.0.lock().end = Some(End::Whole);
    }
}

impl Drop for Writer<'_> {
    fn drop(&mut self) {
        self.0.lock().end.get_or_insert(End::Dropped);
        self.0.changed.notify_all();
    }
}

impl Read for Reader<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let state = self.of.longer_than(self.at)?;
        let read = state.text.get(self.at as usize..).unwrap_or_default().read(out)?;
        self.at += read as u64;
        Ok(read)
    }
}

impl Seek for Reader<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let (from, by) = match to {
            SeekFrom::Start(at) => (at, 0),
            SeekFrom::Current(by) => (self.at, by),
            SeekFrom::End(by) => (self.of.longer_than(u64::MAX)?.text.len() as u64, by),
        };
        self.at = from.checked_add_signed(by).ok_or(io::ErrorKind::InvalidInput)?;
        Ok(self.at)
    }
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    #[test]
    fn a_reader_waits_for_the_end() {
        let growing = Growing::default();
        let read = thread::scope(|scope| {
            let writer = growing.writer();
            let reading = scope.spawn(|| {
                let mut text = String::new();
                growing.reader().read_to_string(&mut text).map(|_| text)
            });
            ["G21\n", "", "G0 X1.\n"].iter().for_each(|part| writer.push(part.as_bytes()));
            writer.finish();
            reading.join().unwrap()
        });
        assert_eq!(read.unwrap(), "G21\nG0 X1.\n");
    }

    #[test]
    fn a_reader_of_a_dropped_program_gets_an_error() {
        let growing = Growing::default();
        growing.writer().push(b"G21\n");
        assert!(growing.reader().read_to_end(&mut Vec::new()).is_err());
    }

    #[test]
    fn a_reader_moves_as_in_a_file() {
        let growing = Growing::default();
        let (writer, mut reader) = (growing.writer(), growing.reader());
        writer.push(b"O1\nM30\n");
        writer.finish();
        let mut text = String::new();
        assert_eq!(reader.seek(SeekFrom::End(-4)).unwrap(), 3);
        reader.read_to_string(&mut text).unwrap();
        assert_eq!(reader.seek(SeekFrom::Current(-7)).unwrap(), 0);
        reader.read_to_string(&mut text).unwrap();
        assert_eq!(reader.seek(SeekFrom::Start(99)).unwrap(), 99);
        assert_eq!(reader.read(&mut [0]).unwrap(), 0);
        assert!(reader.seek(SeekFrom::Current(-100)).is_err());
        assert_eq!(text, "M30\nO1\nM30\n");
    }
}
