//! Writes the digits of a number.

use super::format::{LetterFormat, Point, Sign};
use super::quantise::POWERS;

/// The reason why a quantised value can't be printed in a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unprintable {
    /// The value has more digits before the point than the format allows.
    Overflow,
    /// The value is negative, and the format has no sign.
    Negative,
}

/// Appends a number to `out`. `units` is the number in units of the format's last decimal. `leading_zero` prints `0.5` instead of `.5`.
///
/// Zero is printed as `0`, never as `-0` or `0.`. If the format has fixed digits, zero is printed with more zeros.
/// After an error, `out` is unchanged.
pub fn write_number(
    out: &mut Vec<u8>,
    units: i64,
    format: &LetterFormat,
    leading_zero: bool,
) -> Result<(), Unprintable> {
    Printing::new(*format).write(out, Lead::default(), units, leading_zero)
}

/// A format prepared for printing: flags and limits of a [`LetterFormat`] that are calculated once.
#[derive(Clone, Copy, Debug)]
pub struct Printing {
    format: LetterFormat,
    /// Numbers with a magnitude below this limit are printed by the fast method. The limit is 0 if the fast method does
    /// not support the format.
    short_below: u64,
    /// Digits after the point.
    decimals: u32,
    /// Number of digits after the point that are printed even if they are zeros.
    fixed: u32,
    /// Whether the point is printed even if no fraction follows.
    always_point: bool,
}

impl Printing {
    /// Prepares a format.
    pub fn new(format: LetterFormat) -> Printing {
        let LetterFormat { int, point, dec, .. } = format;
        let is_short = point != Point::Implied && !int.fixed && (1..SHORT_DIGITS).contains(&dec.count);
        let most = POWERS[usize::from((int.count + dec.count).min(SHORT_DIGITS))] as u64;
        let fixed = if dec.fixed { dec.count.into() } else { 0 };
        Printing {
            format,
            short_below: if is_short { most } else { 0 },
            decimals: dec.count.into(),
            fixed,
            always_point: point == Point::Always || fixed > 0,
        }
    }

    /// The format.
    pub fn format(&self) -> &LetterFormat {
        &self.format
    }

    /// Appends `lead` and then the number.
    ///
    /// The other arguments are the arguments of [`write_number`].
    #[inline]
    pub fn write(&self, out: &mut Vec<u8>, lead: Lead, units: i64, leading_zero: bool) -> Result<(), Unprintable> {
        let magnitude = units.unsigned_abs();
        if magnitude >= self.short_below || units == 0 {
            return write_any(out, lead, units, &self.format, leading_zero);
        }
        let mut lead = lead;
        if units < 0 {
            if self.format.sign == Sign::Unsigned {
                return Err(Unprintable::Negative);
            }
            lead.push(b'-');
        } else if self.format.sign == Sign::Always {
            lead.push(b'+');
        }
        let Printing { decimals, fixed, always_point, .. } = *self;
        let digits = eight_digits(magnitude as u32);
        // the first digit is the lowest byte
        let significant = SHORT_DIGITS as u32 - digits.trailing_zeros() / 8;
        let whole = significant.saturating_sub(decimals).max(leading_zero.into());
        let fraction = decimals.saturating_sub(digits.leading_zeros() / 8).max(fixed);
        let text = (digits | ASCII) >> (8 * (SHORT_DIGITS as u32 - decimals - whole));
        let before = text & !(u64::MAX << (8 * whole));
        let point = u64::from(b'.') << (8 * whole);
        let after = u128::from(text >> (8 * whole)) << (8 * (whole + 1));
        let has_point = always_point || fraction > 0;
        let text = (u128::from(before | point) | after) << (8 * lead.length) | u128::from(lead.bytes);
        let length = lead.length + whole + u32::from(has_point) + fraction;
        // copying a fixed length takes two instructions; the excess is then cut off
        let start = out.len();
        out.extend_from_slice(&text.to_le_bytes());
        out.truncate(start + length as usize);
        Ok(())
    }
}

/// Text before a number, such as a space and a letter.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lead {
    bytes: u32,
    length: u32,
}

impl Lead {
    /// Appends a character. There is space for three characters.
    #[inline(always)]
    pub fn push(&mut self, byte: u8) {
        debug_assert!(self.length < 3, "the sign needs the last byte");
        self.bytes |= u32::from(byte) << (8 * self.length);
        self.length += 1;
    }

    /// Appends the text without a number.
    pub fn write(self, out: &mut Vec<u8>) {
        out.extend_from_slice(&self.bytes.to_le_bytes()[..self.length as usize]);
    }
}

/// Maximum number of digits for the fast method: they fit into one register.
const SHORT_DIGITS: u8 = 8;

/// The character `0` in each byte.
const ASCII: u64 = 0x3030_3030_3030_3030;

/// The eight digits of a number below 100,000,000, one in each byte. The first digit is in the lowest byte.
///
/// Each step divides all parts of the register at the same time. The division is a multiplication and a shift, which
/// are exact for parts of this size.
#[inline(always)]
fn eight_digits(value: u32) -> u64 {
    // two groups of four digits, one in each half of the register
    let fours = u64::from(value / 10_000) | u64::from(value % 10_000) << 32;
    // x / 100 for x < 10,000
    let hundreds = ((fours * 5_243) >> 19) & 0x0000_007f_0000_007f;
    let twos = hundreds | (fours - hundreds * 100) << 16;
    // x / 10 for x < 100
    let tens = ((twos * 103) >> 10) & 0x000f_000f_000f_000f;
    tens | (twos - tens * 10) << 8
}

/// Like [`Printing::write`], but for all formats and numbers.
#[cold]
fn write_any(
    out: &mut Vec<u8>,
    lead: Lead,
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
    // write from the last digit to the sign, then copy the text at once
    let mut text = Backwards { bytes: [b'0'; ROOM], at: ROOM };
    let mut end = ROOM;
    if format.is_implied() {
        text.digits(magnitude, if format.int.fixed { format.int.count + decimals } else { 1 });
    } else {
        let scale = POWERS[usize::from(decimals)] as u64;
        let (whole, fraction) = (magnitude / scale, magnitude % scale);
        let fixed_fraction = format.dec.fixed && decimals > 0;
        let point = match format.point {
            Point::Always => units != 0 || fixed_fraction,
            Point::BeforeFraction => fraction != 0 || fixed_fraction,
            Point::Implied => false,
        };
        if point {
            text.digits(fraction, decimals);
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
    lead.write(out);
    out.extend_from_slice(&text.bytes[text.at..end]);
    Ok(())
}

/// Space for the longest number: sign, 18 digits, point, and a leading zero.
const ROOM: usize = 24;
/// A text that is written from its end to its beginning.
struct Backwards {
    bytes: [u8; ROOM],
    at: usize,
}

impl Backwards {
    #[inline]
    fn push(&mut self, byte: u8) {
        self.at -= 1;
        self.bytes[self.at] = byte;
    }

    /// Writes at least `width` digits.
    fn digits(&mut self, mut value: u64, width: u8) {
        let end = self.at;
        while value > 0 || end - self.at < usize::from(width) {
            self.push(b'0' + (value % 10) as u8);
            value /= 10;
        }
    }
}

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
