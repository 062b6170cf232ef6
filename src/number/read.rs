//! Reads decimal numbers. Short numbers are read eight bytes at a time.

/// A decimal number without sign and exponent, of at most 15 digits.
#[derive(Clone, Copy, Debug)]
pub struct Decimal {
    /// The digits as a whole number.
    digits: i64,
    /// Number of digits before the point.
    pub whole: usize,
    /// Number of digits after the point.
    pub decimals: usize,
    /// Whether the number has a point.
    pub point: bool,
    /// Length of the number in bytes.
    pub length: usize,
}

impl Decimal {
    /// The nearest double. Both operands are exact, so the division rounds only once.
    #[inline(always)]
    pub fn value(&self) -> f64 {
        const POWERS: [f64; 16] =
            [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
        self.digits as f64 / POWERS[self.decimals & 15]
    }
}

/// Reads the number at the beginning of the text. `None`: there is no digit, or there are more than 15 digits.
///
/// ```
/// use postform::internals::number::decimal;
/// let number = decimal(b"1234567.891 Y1").unwrap();
/// assert_eq!((number.value(), number.length, number.decimals), (1234567.891, 11, 3));
/// ```
#[inline]
pub fn decimal(text: &[u8]) -> Option<Decimal> {
    short_decimal(text, 0).or_else(|| long_decimal(text))
}

/// Reads a number digit by digit.
#[inline(never)]
fn long_decimal(text: &[u8]) -> Option<Decimal> {
    let (digits, whole) = run_of_digits(text, 0);
    let point = text.get(whole) == Some(&b'.');
    let (digits, decimals) = if point { run_of_digits(&text[whole + 1..], digits) } else { (digits, 0) };
    let fits = (1..=15).contains(&(whole + decimals));
    fits.then_some(Decimal { digits, whole, decimals, point, length: whole + usize::from(point) + decimals })
}

/// Appends the digits at the beginning of `text` to a number. Returns the new number and the count of appended digits.
/// With too many digits the number overflows, so the caller must check the count.
fn run_of_digits(text: &[u8], mut number: i64) -> (i64, usize) {
    let count = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
    for digit in &text[..count] {
        number = number.wrapping_mul(10).wrapping_add(i64::from(digit - b'0'));
    }
    (number, count)
}

/// Reads the number that begins at byte `at` of the text, if it has at most seven digits on each side of the point and at most
/// eight in all. `None`: there is no digit, there are too many digits, or the text is too short. A general reader must then read
/// the number.
///
/// ```
/// use postform::internals::number::short_decimal;
/// let number = short_decimal(b"X-12.50 Y1", 2).unwrap();
/// assert_eq!((number.value(), number.length, number.decimals), (12.5, 5, 2));
/// ```
#[inline(always)]
pub fn short_decimal(text: &[u8], at: usize) -> Option<Decimal> {
    let before = eight_bytes(text, at)?;
    let whole = run_length(before);
    if whole == 8 {
        return None;
    }
    // the first digit is the lowest byte
    let before_point = before & !(u64::MAX << (8 * whole));
    let point = before >> (8 * whole) & 0xff == u64::from(b'.');
    let (digits, decimals) = if point {
        let after = eight_bytes(text, at + whole + 1)?;
        let decimals = run_length(after);
        (before_point | after << (8 * whole), decimals)
    } else {
        (before_point, 0)
    };
    let count = whole + decimals;
    if count == 0 || count > 8 || decimals == 8 {
        return None;
    }
    // bytes after the digits are shifted out, and zeros come in before the first digit
    let digits = (digits << (64 - 8 * count)) & 0x0f0f_0f0f_0f0f_0f0f;
    // join neighbours: digits to pairs, pairs to groups of four digits, and the groups to the number
    let pairs = (digits.wrapping_mul(10 << 8 | 1) >> 8) & 0x00ff_00ff_00ff_00ff;
    let fours = (pairs.wrapping_mul(100 << 16 | 1) >> 16) & 0x0000_ffff_0000_ffff;
    let digits = i64::from((fours.wrapping_mul(10_000 << 32 | 1) >> 32) as u32);
    Some(Decimal { digits, whole, decimals, point, length: whole + usize::from(point) + decimals })
}

/// Eight bytes of the text; the first byte is the lowest. After the end of the text, the bytes are zero.
#[inline(always)]
fn eight_bytes(text: &[u8], at: usize) -> Option<u64> {
    let rest = text.get(at..)?;
    if let Some(bytes) = rest.first_chunk() {
        return Some(u64::from_le_bytes(*bytes));
    }
    let missing = 8 - rest.len() as u32;
    Some(u64::from_le_bytes(*text.last_chunk()?).checked_shr(8 * missing).unwrap_or(0))
}

/// The number of digits at the beginning of eight bytes.
#[inline(always)]
fn run_length(bytes: u64) -> usize {
    // this changes the characters of digits to the values 0 to 9; such a value plus 118 is less than 128
    let bytes = bytes ^ 0x3030_3030_3030_3030;
    let others = (bytes.wrapping_add(0x7676_7676_7676_7676) | bytes) & 0x8080_8080_8080_8080;
    others.trailing_zeros() as usize / 8
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn numbers_end_where_they_end() {
        let read = |text: &str| short_decimal(text.as_bytes(), 0).map(|n| (n.value(), n.whole, n.decimals, n.length));
        assert_eq!(read("12.5 Y3 Z4"), Some((12.5, 2, 1, 4)));
        assert_eq!(read(".25      "), Some((0.25, 0, 2, 3)));
        assert_eq!(read("5.       "), Some((5.0, 1, 0, 2)));
        assert_eq!(read("0000012/:"), Some((12.0, 7, 0, 7)));
        assert_eq!(read("1234567.8"), Some((1_234_567.8, 7, 1, 9)));
        assert_eq!(read("1.23456789"), None);
        assert_eq!(read("12345678."), None);
        assert_eq!(read("1234567.89"), None);
        assert_eq!(read("-1       "), None);
        assert_eq!(read(".        "), None);
        assert_eq!(read("1.5\u{80}\u{ff}    "), Some((1.5, 1, 1, 3)));
        let last = |text: &str, at| short_decimal(text.as_bytes(), at).map(|n| (n.value(), n.length));
        assert_eq!(last("G1 X12.75", 4), Some((12.75, 5)));
        assert_eq!(last("G1 X0012.", 4), Some((12.0, 5)));
        assert_eq!(last("G1 X00127", 8), Some((7.0, 1)));
        assert_eq!((last("G1 X00127", 9), last("G1 X00127", 10)), (None, None));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]
        /// The values are equal to the values of the standard library, wherever the number is in the text.
        #[test]
        fn values_are_the_nearest_doubles(number in "[0-9]{0,7}(\\.[0-9]{0,7})?", before in "[ -~]{0,9}", after in "([ -/:-~][ -~]{0,9})?") {
            let text = format!("{before}{number}{after}");
            let digits = number.bytes().filter(u8::is_ascii_digit).count();
            let ends = !after.starts_with('.') || number.contains('.');
            let found = short_decimal(text.as_bytes(), before.len());
            if ends && (1..=8).contains(&digits) && text.len() >= 8 {
                let found = found.expect(&text);
                prop_assert_eq!(found.length, number.len());
                prop_assert_eq!(found.value().to_bits(), number.parse::<f64>().expect(&number).to_bits());
                prop_assert_eq!(found.whole + found.decimals, digits);
            }
            if digits == 0 && ends {
                prop_assert!(found.is_none());
            }
        }

        /// Long numbers have the values of the standard library, too, and more than 15 digits are refused.
        #[test]
        fn long_values_are_the_nearest_doubles(number in "[0-9]{0,12}(\\.[0-9]{0,12})?", after in "([ -,/:-~][ -~]{0,9})?") {
            let digits = number.bytes().filter(u8::is_ascii_digit).count();
            let found = decimal(format!("{number}{after}").as_bytes());
            prop_assert_eq!(found.is_some(), (1..=15).contains(&digits));
            if let Some(found) = found {
                prop_assert_eq!(found.length, number.len());
                prop_assert_eq!(found.value().to_bits(), number.parse::<f64>().expect(&number).to_bits());
            }
        }
    }
}
