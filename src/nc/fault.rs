//! The error for a block that is refused.

use std::fmt::Display;

use crate::diag::{Code, Diag, Location};
use crate::source::text_of;

/// The reason why a block is refused. The reader adds the line number of the block.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Code of the finding.
    pub code: Code,
    /// The problem, in one sentence.
    pub message: String,
    /// The proposed correction.
    pub help: String,
    /// Column of the letter or number in the block, from 0.
    pub column: Option<usize>,
}

/// A result whose error is a fault. The fault is boxed because it is rare.
pub type Done<T = ()> = Result<T, Box<Fault>>;

impl Fault {
    /// A fault without a column.
    pub fn new(code: Code, message: impl Into<String>, help: impl Into<String>) -> Box<Fault> {
        Box::new(Fault { code, message: message.into(), help: help.into(), column: None })
    }

    /// A fault at a column of the block.
    pub fn at(code: Code, column: usize, message: impl Into<String>, help: impl Into<String>) -> Box<Fault> {
        Box::new(Fault { column: Some(column), ..*Fault::new(code, message, help) })
    }

    /// The fault for text at a column that can't be read.
    pub fn unreadable(line: &[u8], column: usize, text: &str) -> Box<Fault> {
        let is_utf_16 = line.starts_with(b"\xff\xfe") || line.starts_with(b"\xfe\xff");
        let (message, help) = match is_utf_16 {
            true => ("the program is UTF-16".to_owned(), "save it as plain text (ASCII or UTF-8)"),
            false => (format!("`{text}` can't be read"), "remove it, or put it into a comment"),
        };
        Fault::at(Code::PN001, column, message, help)
    }

    /// Converts the fault to a finding about this line of the program.
    pub fn diag(self, line: u64, text: &[u8]) -> Diag {
        let block = text_of(text);
        let block = block.trim();
        let message = if block.is_empty() { self.message } else { format!("{}, in `{block}`", self.message) };
        let column = u32::try_from(self.column.unwrap_or(0)).unwrap_or(u32::MAX).saturating_add(1);
        Diag::new(self.code, message).help(self.help).place(Location::at(line, column))
    }
}

/// The text of a token for a message. A token is at most one byte of a character that is not ASCII; the text is then the
/// whole character.
pub(super) fn quoted(line: &[u8], start: usize, end: usize) -> String {
    match line.get(start) {
        Some(first) if first.is_ascii() => text_of(&line[start..end.max(start + 1)]).into_owned(),
        _ => text_of(line.get(start..).unwrap_or_default()).chars().take(1).collect(),
    }
}

/// Refuses a block: returns a fault without a column.
pub fn refuse<T>(code: Code, message: impl Into<String>, help: impl Into<String>) -> Done<T> {
    Err(Fault::new(code, message, help))
}

/// Refuses a word that is in the block twice. `column`: the column of the second word.
pub fn twice<T>(word: impl Display, column: usize) -> Done<T> {
    Err(Fault::at(Code::PN002, column, format!("{word} is twice in the block"), "keep one of them"))
}

/// Stores the value of a word that a block may contain only once. `column`: the column of the word.
pub fn once<T>(word: &mut Option<T>, value: T, name: &str, column: usize) -> Done {
    if word.replace(value).is_some() { twice(name, column) } else { Ok(()) }
}
