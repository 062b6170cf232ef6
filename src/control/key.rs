//! Keys of `[codes]`: one code, or several at once.

use super::code::Code;
use super::{Row, Rows};

/// The meaning of a code that the control does not have, although the control named by `like` has it.
pub(super) const ABSENT: &str = "absent";

/// A key of `[codes]`.
pub(super) enum Key {
    One(Code),
    /// `G110-G129`: all codes with whole numbers from the first to the last.
    Range(Code, Code),
    /// `G31.*`: all codes with this whole number.
    Number(u8, u16),
    /// `M*`: all other codes of this letter.
    Letter(u8),
}

impl Key {
    pub(super) fn parse(text: &str) -> Option<Key> {
        if let Some((first, last)) = text.split_once('-') {
            let (first, last): (Code, Code) = (first.parse().ok()?, last.parse().ok()?);
            let whole = first.tenths.is_multiple_of(10) && last.tenths.is_multiple_of(10);
            return (whole && first.letter == last.letter && first < last).then_some(Key::Range(first, last));
        }
        if let Some(number) = text.strip_suffix(".*") {
            let code: Code = number.parse().ok()?;
            return code.tenths.is_multiple_of(10).then_some(Key::Number(code.letter, code.tenths / 10));
        }
        match text {
            "G*" => Some(Key::Letter(b'G')),
            "M*" => Some(Key::Letter(b'M')),
            _ => text.parse().ok().map(Key::One),
        }
    }
}

impl Rows {
    /// Removes the inherited rows of these codes.
    pub(super) fn remove(&mut self, key: Key) {
        let out = |row: &Row, number: bool| match key {
            Key::One(code) => !number && row.code == code,
            Key::Range(first, last) => !number && row.code.letter == first.letter && (first..=last).contains(&row.code),
            Key::Number(letter, whole) => row.code.letter == letter && row.code.tenths / 10 == whole,
            Key::Letter(letter) => row.code.letter == letter,
        };
        self.one.retain(|row| !out(row, false));
        self.numbers.retain(|row| !out(row, true));
        if let Key::Letter(letter) = key {
            self.others.retain(|row| row.code.letter != letter);
        }
    }
}
