//! Converts a double to a whole number of units of the last decimal.

/// The largest number of decimals in a letter format.
pub const MAX_DECIMALS: u8 = 9;

/// Powers of ten for the digits of a number. The table goes beyond [`MAX_DECIMALS`].
pub const POWERS: [i64; 19] = {
    let mut powers = [1; 19];
    let mut i = 1;
    while i < 19 {
        powers[i] = powers[i - 1] * 10;
        i += 1;
    }
    powers
};

/// Powers of ten as doubles, for the decimals of a number.
const SCALES: [f64; 10] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];

/// One and a half times 2^52. A double as large as this value has no bits for a fraction. Adding this value to a number
/// therefore rounds the number to a whole number, which is then in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// For values below this magnitude, adding [`ROUNDER`] gives the whole number exactly.
const EXACT: f64 = 2_251_799_813_685_248.0;

/// `value` in units of 10^-`decimals`. The shortest decimal number that reads back as the double is rounded, with
/// halves away from zero.
///
/// `1.00005` with four decimals is 10001, although the double is a little less than that. `None` if the value is not finite
/// or has more than 18 digits.
///
/// ```
/// use postform::internals::number::quantise;
/// assert_eq!(quantise(1.00005, 4), Some(10001));
/// assert_eq!(quantise(-0.5, 0), Some(-1));
/// assert_eq!(quantise(f64::NAN, 3), None);
/// ```
#[inline]
pub fn quantise(value: f64, decimals: u8) -> Option<i64> {
    nearest(value * SCALES[decimals as usize]).or_else(|| by_digits(value, decimals))
}

/// The whole number nearest to `scaled`, a value times a power of ten. `None`: the value is not finite, is very large,
/// or is so near to a half that only its decimal digits show the direction of rounding. Use [`quantise`] then.
#[inline(always)]
pub(crate) fn nearest(scaled: f64) -> Option<i64> {
    let rounded = scaled + ROUNDER;
    let rest = (scaled - (rounded - ROUNDER)).abs();
    // a value differs from its shortest decimal by at most half a unit in the last place, and the product is rounded
    // once more; if the value is nearer to a half than this error, the decimal digits decide. For NaN and infinity,
    // both comparisons are false
    (0.5 - rest > scaled.abs() * (4.0 * f64::EPSILON) && scaled.abs() < EXACT)
        .then(|| (rounded.to_bits() as i64).wrapping_sub(ROUNDER.to_bits() as i64))
}

/// The value in whole units of the last decimal, calculated from the digits of the shortest decimal number that reads
/// back as the value.
#[cold]
fn by_digits(value: f64, decimals: u8) -> Option<i64> {
    if !value.is_finite() {
        return None;
    }
    let (digits, exponent) = shortest(value.abs());
    // the value is digits x 10^exponent; in units it is digits x 10^(exponent + decimals)
    let shift = exponent + i32::from(decimals);
    let units = if shift >= 0 {
        let power = POWERS.get(shift as usize)?;
        digits.checked_mul(*power)?
    } else {
        match POWERS.get((-shift) as usize) {
            Some(&power) => digits / power + i64::from(digits % power >= power / 2),
            None => 0,
        }
    };
    if units >= POWERS[18] {
        return None;
    }
    Some(if value < 0.0 { -units } else { units })
}

/// The shortest decimal number that reads back as a finite double that is not negative: its digits (at most 17) and its
/// exponent of ten.
fn shortest(value: f64) -> (i64, i32) {
    let mut text = Text { bytes: [0; 32], len: 0 };
    // std prints the shortest digits that give the same double again; the buffer has a fixed size, so nothing is allocated
    if std::fmt::Write::write_fmt(&mut text, format_args!("{value:e}")).is_err() {
        return (0, 0);
    }
    let (mut digits, mut exponent, mut after_point) = (0i64, 0i32, false);
    let mut bytes = text.bytes[..text.len].iter();
    for &b in bytes.by_ref() {
        match b {
            b'0'..=b'9' => {
                digits = digits * 10 + i64::from(b - b'0');
                exponent -= i32::from(after_point);
            }
            b'.' => after_point = true,
            _ => break, // 'e'
        }
    }
    let (mut power, mut negative) = (0i32, false);
    for &b in bytes {
        match b {
            b'-' => negative = true,
            _ => power = power * 10 + i32::from(b - b'0'),
        }
    }
    (digits, exponent + if negative { -power } else { power })
}

struct Text {
    bytes: [u8; 32],
    len: usize,
}

impl std::fmt::Write for Text {
    fn write_str(&mut self, s: &str) -> std::fmt::Result {
        let room = self.bytes.get_mut(self.len..self.len + s.len()).ok_or(std::fmt::Error)?;
        room.copy_from_slice(s.as_bytes());
        self.len += s.len();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_go_away_from_zero_of_the_shortest_decimal() {
        for (value, decimals, units) in [
            (1.00005, 4, 10001),
            (-1.00005, 4, -10001),
            (9.99996, 4, 100_000),
            (9.99995, 4, 100_000),
            (0.00004, 4, 0),
            (0.00005, 4, 1),
            (-0.00004, 4, 0),
            (2.5, 0, 3),
            (0.5, 0, 1),
            (0.49999999999999994, 0, 0),
            (1.0000499999999999, 4, 10000),
            (123456.7895, 3, 123_456_790),
            (1e17, 0, 100_000_000_000_000_000),
            (5e-324, 9, 0),
        ] {
            assert_eq!(quantise(value, decimals), Some(units), "{value} at {decimals}");
        }
    }

    #[test]
    fn what_has_no_units_is_none() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, 1e18] {
            assert_eq!(quantise(value, 0), None, "{value}");
        }
        assert_eq!(quantise(1e15, 4), None);
    }
}
