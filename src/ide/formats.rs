//! Example numbers for a letter format.

use crate::number::{LetterFormat, quantise, write_number};

/// Values that show what a format does: a fraction, a negative value, a whole number, digits to be rounded, zero.
const VALUES: [f64; 6] = [12.5, -0.25, 3.0, 1.23456, 0.0, 0.5];

/// Up to three values, each with its text after the letter.
pub fn examples(letter: u8, format: &LetterFormat, leading_zero: bool) -> Vec<(f64, String)> {
    let written = |value: f64| {
        let mut text = vec![letter];
        // a value that is rounded to zero is no useful example
        let units = quantise(value, format.dec.count).filter(|&units| units != 0 || value == 0.0)?;
        write_number(&mut text, units, format, leading_zero).ok()?;
        Some((value, String::from_utf8(text).ok()?))
    };
    let mut found: Vec<(f64, String)> = Vec::new();
    for (value, text) in VALUES.into_iter().filter_map(written) {
        if found.len() < 3 && found.iter().all(|(_, other)| *other != text) {
            found.push((value, text));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_examples_of_a_format() {
        let shown = |spec: &str| {
            let all = examples(b'X', &LetterFormat::parse(spec).unwrap(), false);
            all.into_iter().map(|(value, text)| format!("{value} {text}")).collect::<Vec<_>>().join(", ")
        };
        assert_eq!(shown("->3.>4"), "12.5 X12.5, -0.25 X-.25, 3 X3.");
        assert_eq!(shown("34"), "12.5 X0125000, 3 X0030000, 1.23456 X0012346");
        assert_eq!(shown("2"), "12.5 X13, 3 X03, 1.23456 X01");
        assert_eq!(shown(">1"), "3 X3, 1.23456 X1, 0 X0", "12.5 has too many digits for it");
    }
}
