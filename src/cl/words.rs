//! The words of a statement: numbers, names, and empty fields.

use std::fmt;

use crate::number::short_decimal;

/// One word.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Word {
    /// A number, which is always finite.
    Number(f64),
    /// A name in capitals, or quoted text.
    Name(String),
    /// Digits that would be one number without the blanks between them, such as `15 00`.
    Parted(String),
    /// An empty field between two commas.
    Null,
}

impl Word {
    pub(super) fn number(&self) -> Option<f64> {
        if let Word::Number(value) = self { Some(*value) } else { None }
    }

    pub(super) fn name(&self) -> Option<&str> {
        if let Word::Name(name) = self { Some(name) } else { None }
    }

    /// The text of digits with blanks between them.
    pub(super) fn parted(&self) -> Option<&str> {
        if let Word::Parted(text) = self { Some(text) } else { None }
    }

    pub(super) fn is(&self, name: &str) -> bool {
        self.name() == Some(name)
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Word::Number(value) => write!(f, "{value}"),
            Word::Name(text) | Word::Parted(text) => f.write_str(text),
            Word::Null => f.write_str("nothing"),
        }
    }
}

/// The numbers, if all words are numbers; otherwise `None`.
pub(super) fn numbers(words: &[Word]) -> Option<Vec<f64>> {
    words.iter().map(Word::number).collect()
}

/// The end of a line in a statement that continues on the next line. It is a blank, also in quoted text.
pub(super) const LINE_END: u8 = b'\r';

/// A position of blanks in the text of a word. A word can't contain this character.
const BLANKS: char = '\n';

/// Splits a statement into words at slashes, commas and parentheses. Blanks outside quotes are ignored, but not between the
/// digits of a number: a comma may be missing there, or the digits after the blanks are the number of a punched card. `Err`:
/// the text of a number that is not finite.
pub(super) fn words(text: &[u8]) -> Result<Vec<Word>, String> {
    let (mut list, mut word, mut quoted, mut before) = (Vec::new(), String::new(), false, b'\n');
    let mut after_blanks = false;
    for &byte in text.iter().chain(b"\n") {
        match byte {
            b'\'' => quoted = !quoted,
            b',' | b'/' | b'(' | b')' | b'\n' if !quoted || byte == b'\n' => {
                if !word.is_empty() {
                    list.push(one(&word)?);
                } else if is_empty_field(before, byte) {
                    list.push(Word::Null);
                }
                before = byte;
                word.clear();
                after_blanks = false;
            }
            LINE_END => after_blanks = true,
            b' ' | b'\t' if !quoted => after_blanks = true,
            byte => {
                if std::mem::take(&mut after_blanks) && !word.is_empty() {
                    word.push(BLANKS);
                }
                word.push(char::from(if quoted { byte } else { byte.to_ascii_uppercase() }));
            }
        }
    }
    Ok(list)
}

/// Whether there is an empty field between two separators without a word between them: a comma next to a comma, to a slash
/// or to the end of the statement. `\n` is the beginning or the end.
fn is_empty_field(before: u8, after: u8) -> bool {
    matches!((before, after), (b',' | b'/' | b'\n', b',') | (b',', b'\n'))
}

/// A word from its text. Blanks after the sign of a number are allowed.
fn one(text: &str) -> Result<Word, String> {
    let Some((before, _)) = text.split_once(BLANKS) else { return joined(text) };
    match joined(&text.replace(BLANKS, ""))? {
        Word::Number(_) if text.matches(BLANKS).count() > 1 || !matches!(before, "+" | "-") => {
            Ok(Word::Parted(text.replace(BLANKS, " ")))
        }
        word => Ok(word),
    }
}

/// A word from its text without blanks.
fn joined(word: &str) -> Result<Word, String> {
    let numeric = word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(Word::Number(value)),
        Ok(_) if numeric => Err(word.to_owned()),
        _ => Ok(Word::Name(word.to_owned())),
    }
}

/// The numbers of a plain `GOTO/x,y,z[,i,j,k]`, which is the most frequent statement. `None`: use [`words`] for the statement.
#[inline]
pub(super) fn plain_goto(line: &[u8]) -> Option<([f64; 7], usize)> {
    let rest = line.trim_ascii_start().strip_prefix(b"GOTO")?;
    let mut rest = rest.trim_ascii_start().strip_prefix(b"/")?;
    let mut values = [0.0; 7];
    for (i, value) in values.iter_mut().enumerate() {
        (*value, rest) = number(blanks(rest))?;
        rest = blanks(rest);
        match rest {
            [] => return Some((values, i + 1)),
            [b',', after @ ..] => rest = after,
            _ => return None,
        }
    }
    None
}

#[inline]
fn blanks(mut text: &[u8]) -> &[u8] {
    while let [b' ' | b'\t' | b'\r', rest @ ..] = text {
        text = rest;
    }
    text
}

/// Parses a decimal number of at most 15 digits. The digits and the power of ten are exact as doubles, so one division gives
/// the nearest double.
#[inline]
fn number(text: &[u8]) -> Option<(f64, &[u8])> {
    let (negative, mut rest) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    };
    if let Some(short) = short_decimal(rest, 0) {
        return Some((if negative { -short.value() } else { short.value() }, &rest[short.length..]));
    }
    let (mut value, mut digits, mut decimals) = (0_i64, 0, None);
    loop {
        match rest {
            [digit @ b'0'..=b'9', after @ ..] => {
                value = value.wrapping_mul(10).wrapping_add(i64::from(digit - b'0'));
                digits += 1;
                if let Some(decimals) = &mut decimals {
                    *decimals += 1;
                }
                rest = after;
            }
            [b'.', after @ ..] if decimals.is_none() => {
                decimals = Some(0);
                rest = after;
            }
            _ => break,
        }
    }
    if digits == 0 || digits > 15 {
        return None;
    }
    let value = value as f64 / crate::number::POWERS[decimals.unwrap_or(0)] as f64;
    Some((if negative { -value } else { value }, rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn words_are_parted_by_slashes_commas_and_parentheses() {
        let list = words(b"TLON,GOFWD/ (CIRCLE/ 1., .5, -2,, 3),ON 'a b'").unwrap();
        let shown: Vec<_> = list.iter().map(ToString::to_string).collect();
        assert_eq!(shown, ["TLON", "GOFWD", "CIRCLE", "1", "0.5", "-2", "nothing", "3", "ONa b"]);
        let fields = |text: &[u8]| words(text).unwrap().iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
        assert_eq!(fields(b"GOTO/,1,,2, "), "GOTO nothing 1 nothing 2 nothing");
        assert_eq!(fields(b"RAPID/"), "RAPID");
        assert_eq!(
            words(b"SPINDL/ 1500 ,1ST PECK").unwrap()[1..],
            [Word::Number(1500.0), Word::Name("1STPECK".into())]
        );
        assert!(words(b"GOTO/1e999").is_err());
    }

    #[test]
    fn digits_with_blanks_between_them_are_no_number() {
        for (text, word) in [
            (&b"15 00"[..], Word::Parted("15 00".into())),
            (b"3.      120", Word::Parted("3. 120".into())),
            (b"- 1 2", Word::Parted("- 1 2".into())),
            (b"1\r2", Word::Parted("1 2".into())),
            (b" - 3.5 ", Word::Number(-3.5)),
            (b"'1 2'", Word::Name("1 2".into())),
            (b"100 GO TO", Word::Name("100GOTO".into())),
        ] {
            assert_eq!(words(text).unwrap(), [word], "{}", text.escape_ascii());
        }
    }

    #[test]
    fn plain_gotos_are_read_and_everything_else_is_left() {
        assert_eq!(
            plain_goto(b" GOTO  / 1., -.5 ,3 \r").map(|(v, n)| (v[..n].to_vec(), n)),
            Some((vec![1.0, -0.5, 3.0], 3))
        );
        for other in ["GOTO/1,2,", "GOTO/1,2,3$", "goto/1", "GOTO/1,,2", "GOTO/1e3", "GOTO/-", "GOTO/1.2.3", "GODLTA/1"]
        {
            assert_eq!(plain_goto(other.as_bytes()), None, "{other}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]
        /// The fast parser and the general parser give the same result.
        #[test]
        fn both_ways_read_the_same(text in "[+-]?[0-9]{1,9}(\\.[0-9]{0,6})?|[+-]?\\.[0-9]{1,12}") {
            let line = format!("GOTO/{text}");
            let slow = words(line.as_bytes()).unwrap()[1].number().unwrap();
            let (values, _) = plain_goto(line.as_bytes()).unwrap();
            prop_assert_eq!(values[0].to_bits(), slow.to_bits());
        }
    }
}
