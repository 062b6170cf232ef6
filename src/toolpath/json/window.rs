//! Buffers a part of a document's text (the window), with the line and column where this part begins.

use std::cell::{Cell, RefCell};
use std::io::{Read, Seek};

use super::context::Context;
use super::order::InParts;
use super::strings::{Strings, too_long};

/// A text that may be read in parts.
pub(super) trait Text {
    /// Reads the next bytes. If the bytes do not follow the previous bytes in the file, also returns the line and
    /// column of the first byte.
    fn read_on(&mut self, out: &mut [u8]) -> std::io::Result<(usize, Option<(u64, u32)>)>;

    /// Whether reading begins at the start of the file, where a byte order mark may be.
    const IS_WHOLE: bool;
}

/// A text that is read from start to end.
pub(super) struct AsItStands<R>(pub R);

impl<R: Read> Text for AsItStands<R> {
    #[inline]
    fn read_on(&mut self, out: &mut [u8]) -> std::io::Result<(usize, Option<(u64, u32)>)> {
        Ok((self.0.read(out)?, None))
    }

    const IS_WHOLE: bool = true;
}

impl<R: Read + Seek> Text for InParts<'_, R> {
    fn read_on(&mut self, out: &mut [u8]) -> std::io::Result<(usize, Option<(u64, u32)>)> {
        self.read_part(out)
    }

    const IS_WHOLE: bool = false;
}

/// The part of the text that is buffered and not yet consumed.
pub(super) struct Window {
    pub buffer: RefCell<Box<[u8; 64 * 1024]>>,
    /// The beginning and end of the unconsumed part in the buffer.
    pub from: Cell<usize>,
    pub to: Cell<usize>,
}

impl Default for Window {
    fn default() -> Window {
        Window { buffer: RefCell::new(Box::new([0; 64 * 1024])), from: Cell::new(0), to: Cell::new(0) }
    }
}

/// A reader that counts the lines and columns of the bytes that are consumed. serde_json consumes one byte at a time.
pub(super) struct Counting<'a, R> {
    input: R,
    context: &'a Context,
    strings: Strings,
    window: &'a Window,
}

impl<'a, R: Text> Counting<'a, R> {
    /// A reader of a text. The window holds the bytes that the reader has read but not yet passed on.
    pub fn new(input: R, context: &'a Context, window: &'a Window) -> Counting<'a, R> {
        Counting { input, context, strings: Strings::default(), window }
    }

    /// Reads enough bytes to detect the encoding, and skips the byte order mark of UTF-8. Returns the number of bytes
    /// read.
    pub fn begin(&mut self) -> std::io::Result<usize> {
        let window = self.window;
        while R::IS_WHOLE && window.to.get() < 3 && self.fill()? > 0 {}
        if !R::IS_WHOLE {
            return self.fill();
        }
        if window.buffer.borrow()[..window.to.get()].starts_with(b"\xef\xbb\xbf") {
            window.from.set(3);
        }
        Ok(window.to.get() - window.from.get())
    }

    /// Reads more bytes into the window. Returns 0 at the end of the text.
    fn fill(&mut self) -> std::io::Result<usize> {
        let (mut buffer, to) = (self.window.buffer.borrow_mut(), self.window.to.get());
        loop {
            match self.input.read_on(&mut buffer[to..]) {
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
                Ok((count, begins)) => {
                    if let Some((line, column)) = begins {
                        self.context.at.set((line, column - 1));
                    }
                    // otherwise serde_json would first keep the whole string in memory
                    if !self.strings.take(&buffer[to..to + count]) {
                        return Err(self.context.fail_reading(too_long()));
                    }
                    self.window.to.set(to + count);
                    return Ok(count);
                }
            }
        }
    }
}

impl<R: Text> Read for Counting<'_, R> {
    #[inline]
    fn read(&mut self, out: &mut [u8]) -> std::io::Result<usize> {
        let Window { buffer, from, to } = self.window;
        if from.get() == to.get() {
            from.set(0);
            to.set(0);
            self.fill()?;
        }
        let at = from.get();
        let (Some(&byte), Some(slot)) = (buffer.borrow()[..to.get()].get(at), out.first_mut()) else { return Ok(0) };
        *slot = byte;
        from.set(at + 1);
        let (line, column) = self.context.at.get();
        self.context.at.set(if byte == b'\n' { (line + 1, 0) } else { (line, column + 1) });
        Ok(1)
    }
}
