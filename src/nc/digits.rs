//! Reads the numbers of an NC program, with sign and decimal point. As on a control, spaces are allowed anywhere in a
//! number.

use crate::number::short_decimal;

/// A number as written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// The value of the number: the nearest double.
    pub value: f64,
    /// Whether the number is written with a decimal point.
    pub point: bool,
}

/// Whether a byte is a space or a tab.
#[inline]
pub(super) fn is_blank(byte: u8) -> bool {
    byte == b' ' || byte == b'\t'
}

/// Reads a number with its sign, and returns the byte after it. Leading spaces are skipped. `None`: there is no number
/// at this location.
#[inline(always)]
pub(super) fn signed(line: &[u8], at: usize) -> Option<(Number, usize)> {
    let at = skip_blanks(line, at);
    let (negative, at) = match line.get(at) {
        Some(b'-') => (true, skip_blanks(line, at + 1)),
        Some(b'+') => (false, skip_blanks(line, at + 1)),
        _ => (false, at),
    };
    let (mut number, end) = unsigned(line, at)?;
    if negative {
        number.value = -number.value;
    }
    Some((number, end))
}

/// The first byte from `at` on that is not a space or tab.
#[inline(always)]
pub(super) fn skip_blanks(line: &[u8], mut at: usize) -> usize {
    while line.get(at).is_some_and(|&b| is_blank(b)) {
        at += 1;
    }
    at
}

/// Powers of ten, up to the number of decimal digits that a double represents exactly.
const POWERS: [f64; 16] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// Reads digits with at most one decimal point. Spaces between the digits are ignored.
#[inline(always)]
pub(super) fn unsigned(line: &[u8], start: usize) -> Option<(Number, usize)> {
    if let Some(short) = short_decimal(line, start) {
        let end = start + short.length;
        if !line.get(end).is_some_and(|&b| is_blank(b)) || !goes_on(line, end) {
            return Some((Number { value: short.value(), point: short.point }, end));
        }
    }
    unsigned_of_any_length(line, start)
}

/// Whether a blank is followed by more of the number or by another blank.
#[inline(always)]
fn goes_on(line: &[u8], blank: usize) -> bool {
    matches!(line.get(blank + 1), Some(b'0'..=b'9' | b'.' | b' ' | b'\t'))
}

#[cold]
fn unsigned_of_any_length(line: &[u8], start: usize) -> Option<(Number, usize)> {
    let text = line.get(start..)?;
    let (mantissa, whole) = digits(text, 0);
    let (mut mantissa, mut count, mut decimals, mut at) = (mantissa, whole, 0, whole);
    let point = text.get(at) == Some(&b'.');
    if point {
        (mantissa, decimals) = digits(&text[at + 1..], mantissa);
        (count, at) = (whole + decimals, at + 1 + decimals);
    }
    if text.get(at).is_some_and(|&b| is_blank(b)) && goes_on(line, start + at) {
        return in_parts(line, start);
    }
    number(mantissa, count, decimals, point, &text[..at]).map(|number| (number, start + at))
}

/// Reads the digits at the beginning of a text. Returns the value of `before` followed by these digits, and their number.
#[inline(always)]
fn digits(text: &[u8], before: u64) -> (u64, usize) {
    let (mut mantissa, mut count) = (before, 0);
    for byte in text {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        count += 1;
    }
    (mantissa, count)
}

/// Reads a number that may have spaces between its digits.
#[cold]
fn in_parts(line: &[u8], start: usize) -> Option<(Number, usize)> {
    let (mut mantissa, mut count, mut decimals, mut point) = (0, 0, 0, false);
    let mut at = start;
    loop {
        let part = digits(&line[at..], mantissa);
        mantissa = part.0;
        (count, at) = (count + part.1, at + part.1);
        if point {
            decimals += part.1;
        }
        let next = skip_blanks(line, at);
        match line.get(next) {
            Some(b'0'..=b'9') => at = next,
            Some(b'.') if !point => (point, at) = (true, next + 1),
            _ => break,
        }
    }
    number(mantissa, count, decimals, point, &line[start..at]).map(|number| (number, at))
}

/// The value of a number. `mantissa` is the value of the number's digits without the decimal point; `decimals` is the
/// number of digits after the point. `None`: there are no digits.
#[inline(always)]
fn number(mantissa: u64, count: usize, decimals: usize, point: bool, text: &[u8]) -> Option<Number> {
    let value = match count {
        0 => return None,
        1..=15 => mantissa as f64 / POWERS[decimals], // both are exact, so the quotient is the nearest double
        _ => slow(text),
    };
    Some(Number { value, point })
}

/// Reads a number that has too many digits for the fast method.
#[cold]
fn slow(text: &[u8]) -> f64 {
    let text: String = text.iter().filter(|b| !is_blank(**b)).map(|&b| char::from(b)).collect();
    text.parse().unwrap_or(f64::NAN)
}
