//! Form files as text: decoding, lines and columns.

use std::borrow::Cow;

use crate::span::Span;

/// Interval in bytes at which the number of preceding characters is stored. With these numbers, a column of a long line
/// is found as fast as a column of a short line.
const STEP: usize = 1024;

/// One form file, decoded.
#[derive(Clone, Debug)]
pub struct Source {
    /// The name of the file in messages, as the user gave it.
    pub name: String,
    /// The text after decoding; spans count its bytes.
    pub text: String,
    /// Whether the bytes of the file were read as Windows-1252, because they were not UTF-8.
    pub was_windows_1252: bool,
    line_starts: Vec<u32>,
    /// Number of characters before each interval of bytes.
    characters: Vec<u32>,
}

impl Source {
    /// Decodes a file: UTF-8 with or without byte order mark, else Windows-1252, as in old forms.
    pub fn from_bytes(name: impl Into<String>, bytes: &[u8]) -> Self {
        let body = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        // the end-of-file mark of DOS
        let body = body.strip_suffix(b"\x1a").unwrap_or(body);
        let text = text_of(body);
        let was_windows_1252 = matches!(text, Cow::Owned(_));
        Self::with(name.into(), text.into_owned(), was_windows_1252)
    }

    /// Encodes a text in the encoding of this file.
    ///
    /// # Errors
    /// The first character that Windows-1252 does not have.
    #[doc(hidden)]
    pub fn encoded(&self, text: &str) -> Result<Vec<u8>, char> {
        if !self.was_windows_1252 {
            return Ok(text.as_bytes().to_vec());
        }
        let byte = |letter: char| (0..=u8::MAX).find(|&byte| windows_1252(byte) == letter).ok_or(letter);
        text.chars().map(|letter| if letter.is_ascii() { Ok(letter as u8) } else { byte(letter) }).collect()
    }

    /// A source from text that is in memory already.
    pub fn from_text(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self::with(name.into(), text.into(), false)
    }

    fn with(name: String, text: String, was_windows_1252: bool) -> Self {
        let mut line_starts = vec![0];
        line_starts.extend(memchr::memchr_iter(b'\n', text.as_bytes()).map(|at| at as u32 + 1));
        let (mut characters, mut count) = (vec![0], 0);
        for part in text.as_bytes().chunks(STEP) {
            count += beginnings(part);
            characters.push(count);
        }
        Source { name, text, was_windows_1252, line_starts, characters }
    }

    /// The lines without their line ends, each with the byte at which it starts.
    pub fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        self.line_starts.iter().enumerate().filter_map(|(i, &start)| {
            let start = start as usize;
            let end = self.line_starts.get(i + 1).map_or(self.text.len(), |&next| next as usize);
            let line = &self.text[start..end];
            if line.is_empty() && start == self.text.len() && start > 0 {
                return None; // there is no line after the last line end
            }
            let line = line.strip_suffix('\n').unwrap_or(line);
            // a line may end with several \r, or with spaces after a \r, because some file transfers add a \r
            let words = line.trim_end_matches([' ', '\t', '\r']);
            Some((start, if line[words.len()..].contains('\r') { words } else { line }))
        })
    }

    /// The byte at which each line starts.
    pub fn line_starts(&self) -> &[u32] {
        &self.line_starts
    }

    /// Line and column of a byte, both from 1; columns count characters.
    pub fn line_column(&self, at: u32) -> (u32, u32) {
        let line = self.line(at);
        let column = self.characters_before(at).saturating_sub(self.characters_before(self.line_starts[line]));
        (line as u32 + 1, column + 1)
    }

    /// The line of a byte, from 0.
    pub fn line(&self, at: u32) -> usize {
        self.line_starts.partition_point(|&start| start <= at).max(1) - 1
    }

    fn characters_before(&self, at: u32) -> u32 {
        let at = (at as usize).min(self.text.len());
        let step = at / STEP;
        self.characters[step] + beginnings(&self.text.as_bytes()[step * STEP..at])
    }

    /// The text of a span of this file.
    pub fn slice(&self, span: Span) -> &str {
        self.text.get(span.range()).unwrap_or("")
    }
}

/// Number of characters that begin in these bytes of UTF-8.
fn beginnings(bytes: &[u8]) -> u32 {
    bytes.iter().filter(|&&byte| byte & 0xc0 != 0x80).count() as u32
}

/// The text of bytes: UTF-8, else Windows-1252, as in old files.
pub fn text_of(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| windows_1252(byte)).collect()),
    }
}

/// The character of one Windows-1252 byte. The five bytes that Windows-1252 leaves undefined become the characters with
/// the same numbers, so that nothing is lost.
fn windows_1252(byte: u8) -> char {
    const HIGH: [char; 32] = [
        '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}', '\u{90}', '‘',
        '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
    ];
    match byte {
        0x80..=0x9f => HIGH[usize::from(byte - 0x80)],
        _ => char::from(byte),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_have_no_line_ends_and_the_last_may_lack_one() {
        let lines = |text: &str| Source::from_text("f", text).lines().map(|(_, l)| l.to_owned()).collect::<Vec<_>>();
        assert_eq!(lines("a\r\nb\nc"), ["a", "b", "c"]);
        assert_eq!(lines("a\n"), ["a"]);
        assert_eq!(lines(""), [""]);
        assert_eq!(lines("\n\n"), ["", ""]);
    }

    #[test]
    fn columns_count_characters() {
        let source = Source::from_text("f", "ä b\nc");
        assert_eq!(source.line_column(0), (1, 1));
        assert_eq!(source.line_column(3), (1, 3));
        assert_eq!(source.line_column(5), (2, 1));
        assert_eq!(source.line_column(99), (2, 2));
        let long = Source::from_text("f", "a\n".to_owned() + &"äb".repeat(5_000));
        for characters in [0, 341, 342, 682, 683, 5_000, 9_999] {
            let at = 2 + characters / 2 * 3 + characters % 2 * 2;
            assert_eq!(long.line_column(at), (2, characters + 1));
        }
    }

    #[test]
    fn old_files_are_read_as_windows_1252() {
        let source = Source::from_bytes("f", b"Name Fr\xe4se \x80");
        assert!(source.was_windows_1252);
        assert_eq!(source.text, "Name Fräse €");
        assert_eq!(Source::from_bytes("f", b"\xef\xbb\xbfName x").text, "Name x");
    }
}
