//! Digits from units.

use super::format::{LetterFormat, Point, Sign};
use super::quantise::POWERS;

/// Why a quantised value has no digits in a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unprintable {
    /// More digits before the point than the format has.
    Overflow,
    /// Negative, and the format has no sign.
    Negative,
}

/// Appends `units` (of the format's last decimal) to `out`; `leading_zero` prints `0.5` for `.5`.
///
/// Zero is a bare `0`, never `-0` or `0.`; fixed digits pad it. On an error nothing is appended.
pub fn write_number(
    out: &mut Vec<u8>,
    units: i64,
    format: &LetterFormat,
    leading_zero: bool,
) -> Result<(), Unprintable> {
    let decimals = format.dec.count as usize;
    let magnitude = units.unsigned_abs();
    let scale = POWERS[decimals] as u64;
    let (whole, fraction) = (magnitude / scale, magnitude % scale);
    if whole >= POWERS[format.int.count as usize] as u64 {
        return Err(Unprintable::Overflow);
    }
    match format.sign {
        Sign::Unsigned if units < 0 => return Err(Unprintable::Negative),
        Sign::Always if units > 0 => out.push(b'+'),
        _ if units < 0 => out.push(b'-'),
        _ => {}
    }
    if format.is_implied() {
        let width = if format.int.fixed { format.int.count as usize + decimals } else { 1 };
        push_digits(out, magnitude, width);
        return Ok(());
    }
    let fixed_fraction = format.dec.fixed && decimals > 0;
    let point = match format.point {
        Point::Always => units != 0 || fixed_fraction,
        Point::BeforeFraction => fraction != 0 || fixed_fraction,
        Point::Implied => false,
    };
    if format.int.fixed {
        push_digits(out, whole, format.int.count as usize);
    } else if whole != 0 || !point || leading_zero || units == 0 {
        push_digits(out, whole, 1);
    }
    if point {
        out.push(b'.');
        let start = out.len();
        if decimals > 0 {
            push_digits(out, fraction, decimals);
        }
        if !format.dec.fixed {
            while out.len() > start && out.last() == Some(&b'0') {
                out.pop();
            }
        }
    }
    Ok(())
}

/// Pushes `value` with at least `width` digits.
#[inline]
fn push_digits(out: &mut Vec<u8>, mut value: u64, width: usize) {
    let mut digits = [b'0'; 20];
    let mut at = digits.len();
    while value >= 100 {
        let pair = (value % 100) as usize * 2;
        value /= 100;
        at -= 2;
        digits[at..at + 2].copy_from_slice(&PAIRS[pair..pair + 2]);
    }
    if value >= 10 {
        let pair = value as usize * 2;
        at -= 2;
        digits[at..at + 2].copy_from_slice(&PAIRS[pair..pair + 2]);
    } else if value > 0 {
        at -= 1;
        digits[at] = b'0' + value as u8;
    }
    out.extend_from_slice(&digits[at.min(digits.len() - width)..]);
}

/// The digits 00 to 99: two at a time halves the divisions.
const PAIRS: [u8; 200] = {
    let mut pairs = [0; 200];
    let mut i = 0;
    while i < 100 {
        pairs[i * 2] = b'0' + (i / 10) as u8;
        pairs[i * 2 + 1] = b'0' + (i % 10) as u8;
        i += 1;
    }
    pairs
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::quantise;

    fn print(format: &str, value: f64) -> String {
        shown(format, value, false)
    }

    fn shown(format: &str, value: f64, leading_zero: bool) -> String {
        let format = LetterFormat::parse(format).unwrap();
        let mut out = Vec::new();
        match quantise(value, format.dec.count).map(|units| write_number(&mut out, units, &format, leading_zero)) {
            Some(Ok(())) => String::from_utf8(out).unwrap(),
            Some(Err(why)) => {
                assert!(out.is_empty());
                format!("{why:?}")
            }
            None => "None".into(),
        }
    }

    #[test]
    fn points_and_trailing_zeros() {
        assert_eq!(print("->3.>4", 1.0), "1.");
        assert_eq!(print("->3.>4", -0.5), "-.5");
        assert_eq!(shown("->3.>4", -0.5, true), "-0.5");
        assert_eq!(print("->3.>4", 9.99996), "10.");
        assert_eq!(print("->3.>4", -0.00001), "0");
        assert_eq!(print("->3.>4", 0.0), "0");
        assert_eq!(print("->3.4", 1.5), "1.5000");
        assert_eq!(print("->3.4", 0.0), "0.0000");
        assert_eq!(print("3.1", 5.25), "005.3");
        assert_eq!(print(">3~>1", 54.0), "54");
        assert_eq!(print(">3~>1", 59.1), "59.1");
        assert_eq!(print("+>3.>2", 1.5), "+1.5");
        assert_eq!(print("+>3.>2", 0.0), "0");
    }

    #[test]
    fn implied_points() {
        assert_eq!(print("->34", 0.0123), "123");
        assert_eq!(print("->34", 1.5), "15000");
        assert_eq!(print("->34", 0.0), "0");
        assert_eq!(print("34", 0.0123), "0000123");
    }

    #[test]
    fn whole_numbers() {
        assert_eq!(print("2", 0.0), "00");
        assert_eq!(print("2", 7.0), "07");
        assert_eq!(print(">4", 1234.0), "1234");
        assert_eq!(print(">4", 0.0), "0");
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        assert_eq!(print(">3.>4", 1000.0), "Overflow");
        assert_eq!(print(">3.>4", 999.99996), "Overflow");
        assert_eq!(print(">3.>4", -1.0), "Negative");
        assert_eq!(print(">3.>4", -0.00001), "0");
    }
}
