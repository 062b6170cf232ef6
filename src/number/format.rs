//! Letter formats: `LETTER sign int point dec`.

use super::quantise::MAX_DECIMALS;

/// The sign before the digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Written as a space: no sign is printed, and a negative value is an error.
    Unsigned,
    /// `-`: only negative values have a sign.
    Minus,
    /// `+`: every value has a sign.
    Always,
}

/// Digits on one side of the point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digits {
    /// Number of digits.
    pub count: u8,
    /// Whether exactly this number of digits is printed. Otherwise, this number is the maximum number of digits.
    pub fixed: bool,
}

/// The decimal point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Point {
    /// `.`: printed for every value except zero.
    Always,
    /// `~`: printed only if a fraction follows.
    BeforeFraction,
    /// The decimal point is not printed. The number of decimals gives the control the position of the point.
    Implied,
}

/// The number format of one letter (docs/language.md, "Letter formats").
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LetterFormat {
    /// Sign rule.
    pub sign: Sign,
    /// Digits before the point.
    pub int: Digits,
    /// The point.
    pub point: Point,
    /// Digits after the point.
    pub dec: Digits,
}

/// The reason why a format is invalid. The reason continues a sentence that begins with "the format".
pub type BadFormat = &'static str;

impl LetterFormat {
    /// Reads a format, such as `->3.>4`, `>6`, `34` or `2`. The format may begin with one space.
    pub fn parse(text: &str) -> Result<LetterFormat, BadFormat> {
        let mut rest = text.strip_prefix(' ').unwrap_or(text).as_bytes();
        let sign = match rest.first() {
            Some(b'-') => Sign::Minus,
            Some(b'+') => Sign::Always,
            _ => Sign::Unsigned,
        };
        if sign != Sign::Unsigned {
            rest = &rest[1..];
        }
        let int = digits(&mut rest)?.ok_or("has no number of digits before the point")?;
        let point = match rest.first() {
            Some(b'.') => Point::Always,
            Some(b'~') => Point::BeforeFraction,
            _ => Point::Implied,
        };
        if point != Point::Implied {
            rest = &rest[1..];
        }
        let dec = match digits(&mut rest)? {
            Some(dec) => dec,
            None if point == Point::Implied => Digits { count: 0, fixed: true },
            None => return Err("has a point but no number of decimals"),
        };
        if !rest.is_empty() {
            return Err("has characters after the decimals");
        }
        if dec.count > MAX_DECIMALS {
            return Err("has more than 9 decimals");
        }
        if int.count == 0 && dec.count == 0 {
            return Err("has no digits");
        }
        if point == Point::Implied && dec.count > 0 && !dec.fixed {
            return Err("drops trailing zeros without a point, so the position of the point is lost");
        }
        Ok(LetterFormat { sign, int, point, dec })
    }

    /// A format that is written in the source code. Tests of the tables detect invalid formats.
    pub(crate) fn built_in(text: &str) -> LetterFormat {
        Self::parse(text).unwrap_or(LetterFormat {
            sign: Sign::Minus,
            int: Digits { count: 9, fixed: false },
            point: Point::BeforeFraction,
            dec: Digits { count: 4, fixed: false },
        })
    }

    /// Whether the format has an implied decimal point.
    pub fn is_implied(&self) -> bool {
        self.point == Point::Implied && self.dec.count > 0
    }
}

/// Reads `>n` or `n` from the beginning of the text.
fn digits(rest: &mut &[u8]) -> Result<Option<Digits>, BadFormat> {
    let fixed = rest.first() != Some(&b'>');
    let text = if fixed { *rest } else { &rest[1..] };
    match text.first() {
        Some(b) if b.is_ascii_digit() => {
            *rest = &text[1..];
            Ok(Some(Digits { count: b - b'0', fixed }))
        }
        _ if fixed => Ok(None),
        _ => Err("has `>` without a digit after it"),
    }
}

impl std::fmt::Display for LetterFormat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = |d: Digits| format!("{}{}", if d.fixed { "" } else { ">" }, d.count);
        f.write_str(match self.sign {
            Sign::Unsigned => " ",
            Sign::Minus => "-",
            Sign::Always => "+",
        })?;
        f.write_str(&digits(self.int))?;
        match self.point {
            Point::Always => f.write_str(".")?,
            Point::BeforeFraction => f.write_str("~")?,
            Point::Implied if self.dec.count == 0 => return Ok(()),
            Point::Implied => {}
        }
        f.write_str(&digits(self.dec))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_formats_of_the_texts_read_and_print_back() {
        for (text, canonical) in [
            ("->3.>4", "->3.>4"),
            (" >3.>6", " >3.>6"),
            (">3.>6", " >3.>6"),
            (" ->34", "->34"),
            (" 2", " 2"),
            ("+3.4", "+3.4"),
            (">3~>1", " >3~>1"),
        ] {
            assert_eq!(LetterFormat::parse(text).unwrap().to_string(), canonical);
        }
    }

    #[test]
    fn wrong_ones_say_why() {
        for (text, why) in [
            ("", "no number of digits"),
            ("->", "`>` without"),
            ("->3.", "no number of decimals"),
            ("->3.>4x", "has characters after"),
            ("->3>4", "drops trailing zeros"),
            ("0", "no digits"),
            ("  3", "no number of digits"),
        ] {
            assert!(LetterFormat::parse(text).unwrap_err().contains(why), "{text}");
        }
    }
}
