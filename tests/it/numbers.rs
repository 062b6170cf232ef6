//! Compares the number writer with decimal arithmetic on text, which is slow but simple and shares no code with it.

use postform::internals::number::{LetterFormat, Point, Sign, quantise, write_number};

/// The shortest decimal form of a value, as the digits before and after the point.
fn decimal(value: f64) -> (String, String) {
    let text = format!("{}", value.abs()); // std prints the shortest decimal of the value, without exponent
    match text.split_once('.') {
        Some((whole, fraction)) => (whole.to_owned(), fraction.to_owned()),
        None => (text, String::new()),
    }
}

/// Adds one to a number in digits.
fn increment(digits: &str) -> String {
    let mut bytes: Vec<u8> = digits.bytes().collect();
    for byte in bytes.iter_mut().rev() {
        if *byte < b'9' {
            *byte += 1;
            return String::from_utf8(bytes).unwrap_or_default();
        }
        *byte = b'0';
    }
    format!("1{}", String::from_utf8(bytes).unwrap_or_default())
}

/// The rules of `docs/language.md`, Letter formats, applied to digits. `None`: the value does not fit.
fn oracle(value: f64, format: &LetterFormat, leading_zero: bool) -> Option<String> {
    let places = usize::from(format.dec.count);
    let (whole, fraction) = decimal(value);
    let kept: String = fraction.chars().chain(std::iter::repeat('0')).take(places).collect();
    let rounds_up = fraction.as_bytes().get(places).is_some_and(|&next| next >= b'5');
    let mut digits = format!("{whole}{kept}");
    if rounds_up {
        digits = increment(&digits);
    }
    let (whole, fraction) = digits.split_at(digits.len() - places);
    let whole = whole.trim_start_matches('0');
    let zero = whole.is_empty() && fraction.bytes().all(|b| b == b'0');
    let negative = value < 0.0 && !zero;
    if whole.len() > usize::from(format.int.count) || (negative && format.sign == Sign::Unsigned) {
        return None;
    }
    let padded = format!("{whole:0>width$}", width = usize::from(format.int.count));
    let mut text = String::new();
    if negative {
        text.push('-');
    } else if format.sign == Sign::Always && !zero {
        text.push('+');
    }
    if format.is_implied() {
        let all = if format.int.fixed { format!("{padded}{fraction}") } else { format!("{whole}{fraction}") };
        let shown = if format.int.fixed { all.as_str() } else { all.trim_start_matches('0') };
        text.push_str(if shown.is_empty() { "0" } else { shown });
        return Some(text);
    }
    let shown = if format.dec.fixed { fraction } else { fraction.trim_end_matches('0') };
    let fixed_fraction = format.dec.fixed && places > 0;
    let point = match format.point {
        Point::Always => !zero || fixed_fraction,
        Point::BeforeFraction => !shown.is_empty(),
        Point::Implied => false,
    };
    match whole {
        _ if format.int.fixed => text.push_str(&padded),
        "" if point && !leading_zero && !zero => {}
        "" => text.push('0'),
        whole => text.push_str(whole),
    }
    if point {
        text.push('.');
        text.push_str(shown);
    }
    Some(text)
}

fn written(value: f64, format: &LetterFormat, leading_zero: bool) -> Option<String> {
    let mut out = Vec::new();
    let units = quantise(value, format.dec.count)?;
    write_number(&mut out, units, format, leading_zero).ok()?;
    String::from_utf8(out).ok()
}

/// A small generator with a fixed seed, so that every run uses the same values.
struct Values(u64);

impl Values {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// Values as in jobs, with few decimals. Some values are ties or carries, or the next `f64` after such a value.
    fn value(&mut self) -> f64 {
        let bits = self.next();
        let places = bits % 8;
        let digits = (self.next() % 10u64.pow(1 + (bits >> 8) as u32 % 9)) as f64;
        let mut value = digits / 10f64.powi(places as i32);
        match (bits >> 16) % 8 {
            0 => value += 0.5 / 10f64.powi(places as i32),              // a tie
            1 => value = 10f64.powi((bits >> 20) as i32 % 5) - 0.00004, // a carry
            2 => value = f64::from_bits(value.to_bits() + 1),           // the next double
            3 => value = f64::from_bits(value.to_bits().saturating_sub(1)),
            4 => value /= 3.0, // seventeen digits
            _ => {}
        }
        if bits & 1 << 40 != 0 { -value } else { value }
    }
}

const FORMATS: [&str; 14] = [
    "->3.>4", "->4.>4", "->5.>3", ">6.>4", ">4~>6", ">6", ">3~>1", "->34", "34", "2", "+>3.4", "-3.3", "->3.0",
    "->9.>9",
];

#[test]
fn the_writer_equals_decimal_arithmetic_on_millions_of_values() {
    let formats = FORMATS.map(|text| LetterFormat::parse(text).unwrap_or_else(|why| panic!("{text} {why}")));
    let mut values = Values(0x9e37_79b9_7f4a_7c15);
    for _ in 0..300_000 {
        let value = values.value();
        for format in &formats {
            let leading = value.to_bits() & 1 == 0;
            assert_eq!(written(value, format, leading), oracle(value, format, leading), "{value:?} in {format}");
        }
    }
}

#[test]
fn the_cases_that_break_parts() {
    let print = |value, format: &str| written(value, &LetterFormat::parse(format).ok()?, false);
    for (value, format, expected) in [
        (9.99996, "->3.>4", Some("10.")),
        (999.99995, "->3.>4", None),
        (1.00005, "->3.>4", Some("1.0001")),
        (2.00005, "->3.>4", Some("2.0001")),
        (-0.00004, "->3.>4", Some("0")),
        (-0.00005, "->3.>4", Some("-.0001")),
        (-0.0, "->3.>4", Some("0")),
        (-0.00004, ">3.>4", Some("0")),
        (-1.0, ">3.>4", None),
        (0.0123, "->34", Some("123")),
        (59.1, ">3~>1", Some("59.1")),
        (f64::NAN, "->3.>4", None),
        (f64::INFINITY, "->3.>4", None),
        (1e300, "->3.>4", None),
        (5e-324, "->3.>4", Some("0")),
    ] {
        assert_eq!(print(value, format).as_deref(), expected, "{value} in {format}");
    }
}
