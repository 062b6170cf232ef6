//! Keys of `[codes]`: one code, or several at once.

use super::Rows;
use super::code::Code;

/// The meaning of a code that the control does not have, although the control named by `like` has it.
pub(super) const ABSENT: &str = "absent";

/// A key of `[codes]`.
#[derive(Clone, Copy, Debug)]
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

    /// Whether all codes that this key names have this whole number.
    pub(super) fn is_within(self, letter: u8, whole: u16) -> bool {
        let is = |code: Code| code.letter == letter && code.tenths / 10 == whole;
        match self {
            Key::One(code) => is(code),
            Key::Range(first, last) => is(first) && is(last),
            Key::Number(own, number) => (own, number) == (letter, whole),
            Key::Letter(_) => false,
        }
    }

    /// Whether the key names this code.
    pub(super) fn names(self, code: Code) -> bool {
        match self {
            Key::One(own) => code == own,
            Key::Range(first, last) => code.letter == first.letter && (first..=last).contains(&code),
            Key::Number(letter, whole) => code.letter == letter && code.tenths / 10 == whole,
            Key::Letter(letter) => code.letter == letter,
        }
    }
}

impl Rows {
    /// Removes the inherited rows of these codes. A row for all other codes of the letter does not apply to these codes
    /// either.
    pub(super) fn remove(&mut self, key: Key) {
        self.one.retain(|row| !key.names(row.code));
        if matches!(key, Key::Number(..) | Key::Letter(_)) {
            self.numbers.retain(|row| !key.names(row.code));
        }
        match key {
            Key::Letter(letter) => self.others.retain(|row| row.code.letter != letter),
            key => self.absent.push(key),
        }
    }
}
