//! A fast reader for the three most frequent kinds of lines in a JSON Lines job: `{"line":[1.5,2,-0.1],"feed":300}`,
//! `{"rapid":[1,2,3]}` and `{"point":[1,2,3]}`. serde reads all other lines, including wrong ones, so all errors come
//! from one reader. A property test checks that both readers read the same values.

use crate::number::short_decimal;
use crate::toolpath::Axes;

/// The kind of a plain line. A plain line is one that the fast reader can read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A feed move.
    Line,
    /// A rapid.
    Rapid,
    /// A point of the open cycle.
    Point,
}

/// The content of a plain line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Simple {
    /// The kind of the line.
    pub kind: Kind,
    /// The position.
    pub to: Axes,
    /// The feed; `None` if the line has none.
    pub feed: Option<f64>,
}

/// Reads a plain line and its line end from the beginning of `text`. Returns the line and its length. `None`: the line is
/// not plain, or `text` does not contain its end.
#[inline]
pub fn simple(text: &[u8]) -> Option<(Simple, usize)> {
    let mut at = Cursor::<false> { rest: text };
    if !text.starts_with(b"{\"") {
        at.blanks();
    }
    at.take(b"{")?;
    let simple = at.simple()?;
    if at.take(b"}\n").is_none() {
        at.take(b"}")?;
        at.blanks();
        at.take(b"\n")?;
    }
    Some((simple, text.len() - at.rest.len()))
}

/// Reads a plain item of a document. `text` begins after the opening brace. Returns the item and its length up to the closing
/// brace. Line ends count as spaces. `None`: the item is not plain, or `text` does not contain its end.
#[inline]
pub fn simple_item(text: &[u8]) -> Option<(Simple, usize)> {
    let mut at = Cursor::<true> { rest: text };
    let simple = at.simple()?;
    (at.rest.first() == Some(&b'}')).then(|| (simple, text.len() - at.rest.len()))
}

/// The text after a comma and an opening brace, with spaces around them; `None` if `text` begins differently.
#[inline]
pub fn next_item(text: &[u8]) -> Option<&[u8]> {
    let mut at = Cursor::<true> { rest: text };
    at.blanks();
    at.take(b",")?;
    at.blanks();
    at.take(b"{")?;
    Some(at.rest)
}

/// Reads from the beginning of a text. `LINES`: line ends count as spaces.
struct Cursor<'a, const LINES: bool> {
    rest: &'a [u8],
}

impl<const LINES: bool> Cursor<'_, LINES> {
    /// Reads the members of a plain object.
    #[inline]
    fn simple(&mut self) -> Option<Simple> {
        let kind = if self.take(b"\"line\":[").is_some() {
            Kind::Line
        } else if self.take(b"\"point\":[").is_some() {
            Kind::Point
        } else {
            self.kind()?
        };
        let mut to = Axes::default();
        for axis in 0..6 {
            self.blanks();
            to.set(axis, self.number()?);
            self.blanks();
            if self.take(b",").is_none() {
                break;
            }
            if axis == 5 {
                return None;
            }
        }
        self.take(b"]")?;
        let mut feed = None;
        if !self.rest.starts_with(b"}") {
            self.blanks();
            if kind == Kind::Line && self.take(b",").is_some() {
                self.blanks();
                self.take(b"\"feed\"")?;
                self.colon()?;
                feed = Some(self.number()?);
                self.blanks();
            }
        }
        Some(Simple { kind, to, feed })
    }

    #[inline]
    fn take(&mut self, text: &[u8]) -> Option<()> {
        self.rest = self.rest.strip_prefix(text)?;
        Some(())
    }

    /// Reads the kind of a line and the opening bracket of its position.
    fn kind(&mut self) -> Option<Kind> {
        self.blanks();
        let kind = if self.take(b"\"line\"").is_some() {
            Kind::Line
        } else if self.take(b"\"rapid\"").is_some() {
            Kind::Rapid
        } else {
            self.take(b"\"point\"")?;
            Kind::Point
        };
        self.colon()?;
        self.take(b"[")?;
        Some(kind)
    }

    #[inline]
    fn blanks(&mut self) {
        while let [byte, rest @ ..] = self.rest
            && (matches!(byte, b' ' | b'\t' | b'\r') || LINES && *byte == b'\n')
        {
            self.rest = rest;
        }
    }

    #[inline]
    fn colon(&mut self) -> Option<()> {
        self.blanks();
        self.take(b":")?;
        self.blanks();
        Some(())
    }

    /// Reads a decimal number of at most 15 digits without an exponent. The digits and the power of ten are exact as
    /// doubles, so one division gives the nearest double, as in any correct reader.
    #[inline]
    fn number(&mut self) -> Option<f64> {
        let (negative, digits) = match self.rest {
            [b'-', rest @ ..] => (true, rest),
            rest => (false, rest),
        };
        let Some(short) = short_decimal(digits, 0) else { return self.long_number() };
        let rest = &digits[short.length..];
        // JSON requires a digit before and after the point, and no leading zero before other digits
        if short.whole == 0
            || (short.whole > 1 && digits[0] == b'0')
            || (short.point && short.decimals == 0)
            || matches!(rest, [b'e' | b'E', ..])
        {
            return None;
        }
        self.rest = rest;
        let value = short.value();
        Some(if negative { -value } else { value })
    }

    /// Like [`Cursor::number`], for numbers with more digits.
    #[cold]
    fn long_number(&mut self) -> Option<f64> {
        let (negative, digits) = match self.rest {
            [b'-', rest @ ..] => (true, rest),
            rest => (false, rest),
        };
        let (whole, rest) = run_of_digits(digits, 0);
        let whole_digits = digits.len() - rest.len();
        // JSON requires a digit before the point and no leading zero before other digits
        if whole_digits == 0 || (whole_digits > 1 && digits[0] == b'0') {
            return None;
        }
        let (value, decimals, rest) = match rest {
            [b'.', fraction @ ..] => {
                let (value, rest) = run_of_digits(fraction, whole);
                let decimals = fraction.len() - rest.len();
                if decimals == 0 {
                    return None;
                }
                (value, decimals, rest)
            }
            rest => (whole, 0, rest),
        };
        if whole_digits + decimals > 15 || matches!(rest, [b'e' | b'E', ..]) {
            return None;
        }
        self.rest = rest;
        let value = value as f64 / POWERS[decimals];
        Some(if negative { -value } else { value })
    }
}

/// Appends the digits at the beginning of `bytes` to a value. Too many digits wrap around, so the caller checks their number.
#[inline]
fn run_of_digits(mut bytes: &[u8], mut value: i64) -> (i64, &[u8]) {
    while let [digit @ b'0'..=b'9', rest @ ..] = bytes {
        value = value.wrapping_mul(10).wrapping_add(i64::from(digit - b'0'));
        bytes = rest;
    }
    (value, bytes)
}

/// Powers of ten. Each is exact as a double.
const POWERS: [f64; 16] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn plain_moves_are_read_and_everything_else_is_left() {
        let read = |text: &str| simple(format!("{text}\n").as_bytes()).map(|(read, _)| read);
        assert_eq!(
            read(r#"{"line":[1.5,2,-0.1],"feed":300}"#),
            Some(Simple { kind: Kind::Line, to: Axes::new(&[1.5, 2.0, -0.1]), feed: Some(300.0) })
        );
        assert_eq!(
            read(" { \"rapid\" : [ 1 , 2 ] } \r").map(|m| (m.to, m.kind)),
            Some((Axes::new(&[1.0, 2.0]), Kind::Rapid))
        );
        for other in [
            r#"{"point":[1,2],"feed":5}"#,
            r#"{"line":[1,null]}"#,
            r#"{"line":[]}"#,
            r#"{"line":[1,2,3,4,5,6,7]}"#,
            r#"{"line":[01]}"#,
            r#"{"line":[1.]}"#,
            r#"{"line":[.5]}"#,
            r#"{"line":[1e3]}"#,
            r#"{"line":[1,2],"feed":5,"x":1}"#,
            r#"{"feed":5,"line":[1,2]}"#,
            r#"{"line":[1,2]}}"#,
            r#"{"line":[1,2],}"#,
            r#"{"line":[1,2"#,
            "",
        ] {
            assert_eq!(read(other), None, "{other}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]
        /// The fast reader reads the same numbers as serde_json.
        #[test]
        fn numbers_are_those_of_serde(text in "-?(0|[1-9][0-9]{0,8})(\\.[0-9]{1,9})?") {
            let expected: f64 = serde_json::from_str(&text).unwrap();
            // the number is at the end of the text, or more text follows
            for rest in ["", "{\"line\":[1,2]}\n"] {
                let line = format!("{{\"line\":[{text}]}}\n{rest}");
                if let Some((found, length)) = simple(line.as_bytes()) {
                    prop_assert_eq!(found.to.values[0].to_bits(), expected.to_bits());
                    prop_assert_eq!(length, line.len() - rest.len());
                } else {
                    let digits = text.bytes().filter(u8::is_ascii_digit).count();
                    prop_assert!(digits > 15, "{} is plain", text);
                }
            }
        }
    }
}
