//! Reads the lines of a CL file, of which statements consist.

use std::io::{ErrorKind, Read, Result};

/// Maximum length of a line or statement in bytes. A file with a longer line or statement is not a CL file.
pub(super) const LONGEST: usize = 1 << 20;

/// The lines of an input. Only the buffered part of the input is in memory.
pub(super) struct Lines<R> {
    input: R,
    buffer: Vec<u8>,
    from: usize,
    to: usize,
    at_end: bool,
}

impl<R: Read> Lines<R> {
    pub(super) fn new(input: R) -> Self {
        Lines { input, buffer: vec![0; 256 * 1024], from: 0, to: 0, at_end: false }
    }

    /// The first lines, which are not consumed: at most `most`, and only those that fit into the buffer.
    pub(super) fn ahead(&mut self, most: usize) -> Result<impl Iterator<Item = &[u8]>> {
        while !self.at_end
            && self.to < self.buffer.len()
            && memchr::memchr_iter(b'\n', &self.buffer[self.from..self.to]).count() < most
        {
            self.fill()?;
        }
        Ok(self.buffer[self.from..self.to].split(|&byte| byte == b'\n').take(most))
    }

    /// Reads more input into the buffer.
    fn fill(&mut self) -> Result<()> {
        match self.input.read(&mut self.buffer[self.to..]) {
            Ok(0) => self.at_end = true,
            Ok(count) => self.to += count,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
        Ok(())
    }

    /// The next line without its line end; `None` at the end of the input. A line that is too long is cut just above the maximum length.
    pub(super) fn next(&mut self) -> Result<Option<&[u8]>> {
        loop {
            if let Some(length) = memchr::memchr(b'\n', &self.buffer[self.from..self.to]) {
                let start = self.from;
                self.from += length + 1;
                return Ok(Some(&self.buffer[start..start + length]));
            }
            if self.at_end || self.to - self.from > LONGEST {
                let line = self.from..self.to;
                self.from = self.to;
                return Ok((!line.is_empty()).then(|| &self.buffer[line]));
            }
            self.buffer.copy_within(self.from..self.to, 0);
            (self.to, self.from) = (self.to - self.from, 0);
            if self.to == self.buffer.len() {
                self.buffer.resize(self.to * 2, 0);
            }
            self.fill()?;
        }
    }
}

/// Words that begin a text statement, with or without a slash. The text of these words extends to the end of the line.
const TEXT: [&str; 10] = [
    "PARTNO",
    "PPRINT",
    "TPRINT",
    "DISPLY",
    "INSERT",
    "REMARK",
    "LETTER",
    "CSI_INSERT_CUSTOM_GCODE",
    "CSI_PROGRAM_COMMENT",
    "CSI_TOOL_PATH",
];

/// The text word at the beginning of a line, and the text after it.
pub(super) fn text_statement(line: &[u8]) -> Option<(&'static str, &[u8])> {
    let word =
        TEXT.into_iter().find(|w| line.len() >= w.len() && line[..w.len()].eq_ignore_ascii_case(w.as_bytes()))?;
    let rest = line[word.len()..].trim_ascii_start();
    let text = rest.strip_prefix(b"/").unwrap_or(rest).trim_ascii();
    let quoted = text.strip_prefix(b"'").and_then(|text| text.strip_suffix(b"'"));
    Some((word, quoted.unwrap_or(text).trim_ascii()))
}

/// The line without its comment (after `$$`), and whether it continues on the next line (`$`). Text after the `$` is ignored.
pub(super) fn without_comment(line: &[u8]) -> (&[u8], bool) {
    let mut quoted = false;
    for (i, &byte) in line.iter().enumerate() {
        match byte {
            b'\'' => quoted = !quoted,
            b'$' if !quoted => return (&line[..i], line.get(i + 1) != Some(&b'$')),
            _ => {}
        }
    }
    (line, false)
}
