//! Writes the digits of a number.

use super::format::{LetterFormat, Point, Sign};
use super::quantise::POWERS;

/// The reason why a quantised value can't be printed in a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unprintable {
    /// It has more digits before the point than the format.
    Overflow,
    /// It is negative, and the format has no sign.
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
    let decimals = format.dec.count;
    let magnitude = units.unsigned_abs();
    if magnitude >= POWERS[usize::from(format.int.count + decimals)] as u64 {
        return Err(Unprintable::Overflow);
    }
    if units < 0 && format.sign == Sign::Unsigned {
        return Err(Unprintable::Negative);
    }
    // from the last digit to the sign, then copied as one piece
    let mut text = Backwards { bytes: [b'0'; ROOM + SHORT], at: ROOM };
    let mut end = ROOM;
    if format.is_implied() {
        text.digits(magnitude, if format.int.fixed { format.int.count + decimals } else { 1 });
    } else {
        let (whole, fraction) = split(magnitude, decimals);
        let fixed_fraction = format.dec.fixed && decimals > 0;
        let point = match format.point {
            Point::Always => units != 0 || fixed_fraction,
            Point::BeforeFraction => fraction != 0 || fixed_fraction,
            Point::Implied => false,
        };
        if point {
            text.fraction(fraction, decimals);
            if !format.dec.fixed {
                while end > text.at && text.bytes[end - 1] == b'0' {
                    end -= 1;
                }
            }
            text.push(b'.');
        }
        if format.int.fixed {
            text.digits(whole, format.int.count);
        } else if whole != 0 || !point || leading_zero || units == 0 {
            text.digits(whole, 1);
        }
    }
    if units < 0 {
        text.push(b'-');
    } else if format.sign == Sign::Always && units > 0 {
        text.push(b'+');
    }
    let (start, length) = (out.len(), end - text.at);
    match text.bytes[text.at..].first_chunk::<SHORT>() {
        // a copy of fixed length is two instructions; the excess is cut off afterwards
        Some(short) if length <= SHORT => {
            out.extend_from_slice(short);
            out.truncate(start + length);
        }
        _ => out.extend_from_slice(&text.bytes[text.at..end]),
    }
    Ok(())
}

/// Room for the longest number: sign, 18 digits, point, a leading zero.
const ROOM: usize = 24;
/// Almost every number is shorter than this.
const SHORT: usize = 16;

/// Whole part and fraction. Division by a constant compiles to a multiplication, so each usual number of decimals has its own branch.
#[inline]
fn split(magnitude: u64, decimals: u8) -> (u64, u64) {
    if let (Ok(small), 1..=6) = (u32::try_from(magnitude), decimals) {
        let (whole, fraction) = match decimals {
            1 => (small / 10, small % 10),
            2 => (small / 100, small % 100),
            3 => (small / 1000, small % 1000),
            4 => (small / 10_000, small % 10_000),
            5 => (small / 100_000, small % 100_000),
            _ => (small / 1_000_000, small % 1_000_000),
        };
        return (whole.into(), fraction.into());
    }
    let scale = POWERS[usize::from(decimals)] as u64;
    (magnitude / scale, magnitude % scale)
}

/// Text that grows to the front.
struct Backwards {
    bytes: [u8; ROOM + SHORT],
    at: usize,
}

impl Backwards {
    #[inline]
    fn push(&mut self, byte: u8) {
        self.at -= 1;
        self.bytes[self.at] = byte;
    }

    /// Writes a fraction with exactly this many digits.
    #[inline(always)]
    fn fraction(&mut self, fraction: u64, decimals: u8) {
        let Ok(mut rest) = u32::try_from(fraction) else { return self.digits(fraction, decimals) };
        let mut left = decimals;
        while left >= 2 {
            self.pair((rest % 100) as usize);
            rest /= 100;
            left -= 2;
        }
        if left == 1 {
            self.push(b'0' + (rest % 10) as u8);
        }
    }

    /// Writes at least `width` digits.
    #[inline]
    fn digits(&mut self, mut value: u64, width: u8) {
        let mut left = width;
        while value > u64::from(u32::MAX) {
            self.pair((value % 100) as usize);
            value /= 100;
            left = left.saturating_sub(2);
        }
        let mut value = value as u32;
        while value >= 100 || left >= 2 {
            self.pair((value % 100) as usize);
            value /= 100;
            left = left.saturating_sub(2);
        }
        if value >= 10 {
            self.pair(value as usize);
        } else if value > 0 || left > 0 {
            self.push(b'0' + value as u8);
        }
    }

    #[inline]
    fn pair(&mut self, value: usize) {
        self.at -= 2;
        self.bytes[self.at..self.at + 2].copy_from_slice(&PAIRS[value * 2..value * 2 + 2]);
    }
}

/// The digits 00 to 99: writing two digits at a time halves the number of divisions.
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
