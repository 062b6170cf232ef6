//! A code of a control: a letter and a number with at most one decimal.

use std::fmt;
use std::str::FromStr;

/// A code. The number is stored in whole tenths, so `G59.1` is never rounded to `G59`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code {
    /// `G` or `M`; a command of a form may have another letter.
    pub letter: u8,
    /// Ten times the number.
    pub tenths: u16,
}

impl Code {
    /// The G code with this whole number, which must be below 6554.
    pub const fn g(number: u16) -> Code {
        Code { letter: b'G', tenths: number * 10 }
    }

    /// The M code with this whole number, which must be below 6554.
    pub const fn m(number: u16) -> Code {
        Code { letter: b'M', tenths: number * 10 }
    }

    /// The code for a word's letter and value. `None`: the letter is not G or M, the value is negative, or the value
    /// has more than one decimal.
    pub fn of(letter: u8, value: f64) -> Option<Code> {
        let letter = letter.to_ascii_uppercase();
        let tenths = value * 10.0;
        let whole = tenths.round();
        let is_code = matches!(letter, b'G' | b'M') && (tenths - whole).abs() < 1e-6;
        (is_code && (0.0..=f64::from(u16::MAX)).contains(&whole)).then_some(Code { letter, tenths: whole as u16 })
    }

    /// Whether the code is the G code with this number.
    pub fn is_g(self, number: f64) -> bool {
        self.letter == b'G' && self.value() == number
    }

    /// The number after the letter.
    pub fn value(self) -> f64 {
        f64::from(self.tenths) / 10.0
    }
}

/// The default is `G0`.
impl Default for Code {
    fn default() -> Self {
        Code::g(0)
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", char::from(self.letter), self.tenths / 10)?;
        match self.tenths % 10 {
            0 => Ok(()),
            tenth => write!(f, ".{tenth}"),
        }
    }
}

/// The error for a text that is not a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoCode;

impl FromStr for Code {
    type Err = NoCode;

    /// Reads a code such as `G0`, `G59.1` or `M3`.
    fn from_str(text: &str) -> Result<Code, NoCode> {
        let letter = *text.as_bytes().first().ok_or(NoCode)?;
        let number = text.get(1..).ok_or(NoCode)?;
        let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
        let (whole, tenth) = number.split_once('.').unwrap_or((number, "0"));
        if !matches!(letter, b'G' | b'M') || !digits(whole) || !digits(tenth) || tenth.len() != 1 {
            return Err(NoCode);
        }
        let number = |part: &str| part.parse::<u16>().map_err(|_| NoCode);
        let tenths = number(whole)?.checked_mul(10).and_then(|ten| ten.checked_add(number(tenth).ok()?));
        Ok(Code { letter, tenths: tenths.ok_or(NoCode)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_read_and_shown() {
        for text in ["G0", "G59.1", "M3", "G154", "G6553.5"] {
            assert_eq!(text.parse::<Code>().unwrap().to_string(), text);
        }
        for text in ["", "G", "G1.23", "X1", "G-1", "G1.", "g1", "G99999", "G+1", "G 1"] {
            assert_eq!(text.parse::<Code>(), Err(NoCode), "{text}");
        }
        assert_eq!(Code::of(b'g', 59.1), Some(Code { letter: b'G', tenths: 591 }));
        assert_eq!(
            [Code::of(b'G', 5.15), Code::of(b'G', -1.0), Code::of(b'X', 1.0), Code::of(b'G', f64::NAN)],
            [None; 4]
        );
    }
}
