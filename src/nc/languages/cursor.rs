//! Reads the text of a block from left to right.

use std::borrow::Cow;

use crate::diag::Code;
use crate::nc::digits::{signed, unsigned};
use crate::nc::fault::{Done, Fault};

/// A block that is being read. Spaces between the parts of the block are skipped.
pub struct Cursor<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    /// A cursor that reads a text from byte `at` on.
    pub fn new(text: &'a [u8], at: usize) -> Cursor<'a> {
        let mut cursor = Cursor { text, at };
        cursor.skip_blanks();
        cursor
    }

    fn skip_blanks(&mut self) {
        while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    /// A cursor for the same block at another byte.
    pub fn from(&self, at: usize) -> Cursor<'a> {
        Cursor::new(self.text, at)
    }

    fn goes_to(&mut self, at: usize) {
        self.at = at;
        self.skip_blanks();
    }

    /// The byte offset of the cursor.
    pub fn at(&self) -> usize {
        self.at
    }

    /// The part of the block that has not been read yet.
    pub fn rest(&self) -> &'a [u8] {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// Returns the next byte without taking it.
    pub fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    /// Whether the whole block has been read.
    pub fn is_over(&self) -> bool {
        self.at >= self.text.len()
    }

    /// Takes these bytes if they come next. Returns whether these bytes come next.
    pub fn takes(&mut self, bytes: &[u8]) -> bool {
        let is_next = self.rest().starts_with(bytes);
        if is_next {
            self.goes_to(self.at + bytes.len());
        }
        is_next
    }

    /// Takes a word if it comes next as a whole word, in upper or lower case.
    pub fn takes_word(&mut self, word: &str) -> bool {
        let before = self.at;
        if self.name().is_some_and(|name| name.eq_ignore_ascii_case(word.as_bytes())) {
            return true;
        }
        self.at = before;
        false
    }

    /// Takes a name: letters, digits, `_` and `$`, but not a digit at its beginning.
    pub fn name(&mut self) -> Option<&'a [u8]> {
        let is_of_name = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'$');
        let length = self.rest().iter().take_while(|byte| is_of_name(byte)).count();
        self.take(length).filter(|name| !name[0].is_ascii_digit())
    }

    /// Takes the letters that come next.
    pub fn letters(&mut self) -> Option<&'a [u8]> {
        let length = self.rest().iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        self.take(length)
    }

    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let taken = self.rest().get(..length).filter(|taken| !taken.is_empty())?;
        self.goes_to(self.at + length);
        Some(taken)
    }

    /// Skips the digits that come next.
    pub fn pass_digits(&mut self) {
        let length = self.rest().iter().take_while(|byte| byte.is_ascii_digit()).count();
        self.goes_to(self.at + length);
    }

    /// Takes a word of one letter and a number, such as `X12.5`. The letter is returned in upper case. Words with `=`
    /// or a parameter, such as `X=5`, `X1=5` and `X+Q5`, are not taken.
    pub fn word(&mut self) -> Option<(u8, f64)> {
        let [letter, next, ..] = *self.rest() else { return None };
        if !letter.is_ascii_alphabetic() || next.is_ascii_alphabetic() {
            return None;
        }
        let (number, end) = signed(self.text, self.at + 1)?;
        let before = self.at;
        self.goes_to(end);
        if self.peek() == Some(b'=') {
            self.at = before;
            return None;
        }
        Some((letter.to_ascii_uppercase(), number.value))
    }

    /// Whether the rest of the block consists only of words with one letter, of which the first is G or an axis. A
    /// block of only these words has no label, sets no variable and calls nothing.
    pub fn is_words(&self) -> bool {
        let [letter, next, ..] = *self.rest() else { return false };
        matches!(letter, b'G' | b'X' | b'Y' | b'Z' | b'A' | b'B' | b'C')
            && matches!(next, b'0'..=b'9' | b'+' | b'-' | b'.')
            && memchr::memchr2(b'=', b':', self.rest()).is_none()
    }

    /// Whether these bytes come next, in upper or lower case. `capitals` must be in upper case.
    pub fn is_next(&self, capitals: &[u8]) -> bool {
        self.rest().get(..capitals.len()).is_some_and(|next| next.eq_ignore_ascii_case(capitals))
    }

    /// Takes a number without a sign.
    pub fn unsigned(&mut self) -> Option<f64> {
        let (number, end) = unsigned(self.text, self.at)?;
        self.goes_to(end);
        Some(number.value)
    }

    /// Takes a number with or without a sign.
    pub fn signed(&mut self) -> Option<f64> {
        let (number, end) = signed(self.text, self.at)?;
        self.goes_to(end);
        Some(number.value)
    }

    /// Takes a text in quotes. Returns the text without the quotes.
    pub fn quoted(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest().strip_prefix(b"\"")?;
        let length = rest.iter().position(|byte| *byte == b'"')?;
        self.goes_to(self.at + length + 2);
        Some(&rest[..length])
    }

    /// Skips the text up to the bracket that closes an open `(`, and the bracket itself.
    ///
    /// # Errors
    /// The bracket is missing.
    pub fn pass_brackets(&mut self) -> Done {
        let mut depth = 1;
        for (length, byte) in self.rest().iter().enumerate() {
            depth += i32::from(*byte == b'(') - i32::from(*byte == b')');
            if depth == 0 {
                self.goes_to(self.at + length + 1);
                return Ok(());
            }
        }
        self.goes_to(self.text.len());
        self.needs(b")")
    }

    /// Takes these bytes, which must come next.
    ///
    /// # Errors
    /// Other bytes come next.
    pub fn needs(&mut self, bytes: &[u8]) -> Done {
        if self.takes(bytes) {
            return Ok(());
        }
        let message = format!("`{}` is missing", String::from_utf8_lossy(bytes));
        Err(Fault::at(Code::PN001, self.at, message, "check the spelling"))
    }

    /// The fault for text at the cursor that can't be read.
    pub fn unreadable(&self) -> Box<Fault> {
        let rest = String::from_utf8_lossy(self.rest());
        let word: String = rest.trim_end().chars().take_while(|c| !c.is_whitespace()).take(40).collect();
        if word.is_empty() {
            let help = "remove it, or put it into a comment";
            return Fault::at(Code::PN001, self.at, "the block ends too early", help);
        }
        Fault::unreadable(self.text, self.at, &word)
    }
}

/// A word in upper case. A word that is already in upper case, as in most programs, is not copied.
pub fn capitals(word: &[u8]) -> Cow<'_, str> {
    match str::from_utf8(word) {
        Ok(text) if !word.iter().any(u8::is_ascii_lowercase) => Cow::Borrowed(text),
        _ => Cow::Owned(String::from_utf8_lossy(word).to_ascii_uppercase()),
    }
}
