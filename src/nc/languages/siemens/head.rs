//! Reads the beginning of a line: its number, its label and its first word. Also finds the program parts that a word opens or ends.

use std::borrow::Cow;

use super::super::cursor::{Cursor, capitals};

/// The words that open a part of the program, each with the word that ends the part.
pub const PARTS: [(&str, &str); 5] =
    [("IF", "ENDIF"), ("WHILE", "ENDWHILE"), ("FOR", "ENDFOR"), ("LOOP", "ENDLOOP"), ("REPEAT", "UNTIL")];

/// The beginning of a line.
#[derive(Default)]
pub struct Head<'l> {
    /// The block number, from `N100`.
    number: Option<f64>,
    label: Option<Cow<'l, str>>,
    /// The first word after the block number and the label, in upper case.
    pub word: Cow<'l, str>,
    /// The byte at which the statement begins.
    pub start: usize,
}

impl Head<'_> {
    /// Whether this line is the target of a jump to a label. The label may also be a block number such as `N100`.
    pub fn is(&self, label: &str) -> bool {
        self.label.as_deref() == Some(label)
            || self.number.is_some_and(|number| label.strip_prefix('N').is_some_and(|own| own == number.to_string()))
    }
}

/// The line without its comment, and the columns of the comment.
pub fn without_comment(line: &[u8]) -> (&[u8], Option<(usize, usize)>) {
    if memchr::memchr(b';', line).is_none() {
        return (line, None);
    }
    let mut quoted = false;
    for (at, byte) in line.iter().enumerate() {
        match byte {
            b'"' => quoted = !quoted,
            b';' if !quoted => return (&line[..at], Some((at + 1, line.trim_ascii_end().len()))),
            _ => {}
        }
    }
    (line, None)
}

/// The block number of a line, and a cursor after it.
pub fn number(line: &[u8]) -> (Option<f64>, Cursor<'_>) {
    let mut cursor = Cursor::new(line, 0);
    while cursor.peek() == Some(b'/') {
        cursor.takes(b"/");
        if cursor.peek().is_some_and(|byte| byte.is_ascii_digit()) {
            cursor.unsigned();
        }
    }
    let is_number = |text: &[u8]| text.len() > 1 && matches!(text[0], b'N' | b'n' | b':') && text[1].is_ascii_digit();
    if !is_number(cursor.rest()) {
        return (None, cursor);
    }
    cursor = cursor.from(cursor.at() + 1);
    let number = cursor.unsigned().unwrap_or(0.0);
    (Some(number), cursor)
}

/// Reads the beginning of a line.
pub fn head(line: &[u8]) -> Head<'_> {
    let (number, mut cursor) = number(without_comment(line).0);
    let mut head = Head { number, start: cursor.at(), ..Head::default() };
    if let Some(name) = cursor.name() {
        let name = capitals(name);
        if cursor.peek() == Some(b':') && cursor.rest().get(1) != Some(&b'=') {
            cursor.takes(b":");
            head.label = Some(name);
            head.start = cursor.at();
            head.word = cursor.name().map(capitals).unwrap_or_default();
        } else {
            head.word = name;
        }
    }
    head
}

/// The name of the section that begins at this line, from `%_N_NAME_SPF` or `PROC NAME`.
pub fn section(line: &[u8]) -> Option<String> {
    let text = line.trim_ascii();
    let name = if let Some(name) = text.strip_prefix(b"%_N_") {
        let name = String::from_utf8_lossy(name).to_ascii_uppercase();
        let name = name.strip_suffix("_SPF").or(name.strip_suffix("_MPF")).unwrap_or(&name).to_owned();
        return Some(name);
    } else {
        // most lines have no P
        let head = memchr::memchr2(b'P', b'p', text).map(|_| head(line))?;
        if head.word != "PROC" {
            return None;
        }
        let mut cursor = Cursor::new(line, head.start);
        cursor.name();
        cursor.name()?
    };
    Some(String::from_utf8_lossy(name).to_ascii_uppercase())
}

/// The index in `PARTS` of the part that a line opens.
pub fn opens(head: &Head<'_>, line: &[u8]) -> Option<usize> {
    let at = PARTS.iter().position(|(open, _)| *open == head.word)?;
    let rest = String::from_utf8_lossy(without_comment(line).0).to_ascii_uppercase();
    match head.word.as_ref() {
        "IF" if rest.contains("GOTO") => None,
        // `REPEAT LABEL P=3` opens no part: it repeats earlier lines
        "REPEAT" if rest[head.start.min(rest.len())..].trim() != "REPEAT" => None,
        _ => Some(at),
    }
}
