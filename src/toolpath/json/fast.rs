//! A fast reader for the three most frequent kinds of lines in a JSON Lines job: `{"line":[1.5,2,-0.1],"feed":300}`,
//! `{"rapid":[1,2,3]}` and `{"point":[1,2,3]}`. serde reads all other lines, including lines with errors, so all error
//! messages come from serde's reader. A property test checks that the fast reader and serde read the same values.

use crate::number::decimal;
use crate::toolpath::Axes;

/// The kind of a plain line. A plain line is a line that the fast reader can read.
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

    /// Reads a decimal number of at most 15 digits without an exponent.
    #[inline]
    fn number(&mut self) -> Option<f64> {
        let (negative, digits) = match self.rest {
            [b'-', rest @ ..] => (true, rest),
            rest => (false, rest),
        };
        let number = decimal(digits)?;
        let rest = &digits[number.length..];
        // JSON requires a digit before and after the point, and no leading zero before other digits
        if number.whole == 0
            || (number.whole > 1 && digits[0] == b'0')
            || (number.point && number.decimals == 0)
            || matches!(rest, [b'e' | b'E', ..])
        {
            return None;
        }
        self.rest = rest;
        let value = number.value();
        Some(if negative { -value } else { value })
    }
}

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
