//! Conversion of values to units of a letter's last decimal, and errors for values that do not fit the format.

use super::fault::{Done, fault};
use crate::compile::{Letter, LetterKind};
use crate::diag::Code;
use crate::number::{LetterFormat, POWERS, Unprintable, quantise};

/// Converts a value to units of its letter's last decimal. Reverses the sign if the form reverses the sign of the
/// letter.
#[inline(always)]
pub fn quantised(info: &Letter, value: f64) -> Done<i64> {
    let value = if info.reversed { -value } else { value };
    match quantise(value, info.format.dec.count) {
        Some(units) => {
            if matches!(info.kind, LetterKind::GCode | LetterKind::MCode) {
                check_code(info, value, units)?;
            }
            Ok(units)
        }
        None => no_number(&char::from(info.printed).to_string(), value, &info.format),
    }
}

/// Converts a value to units of a format's last decimal. `what` names the value in messages.
pub fn units_of(value: f64, format: &LetterFormat, what: &str) -> Done<i64> {
    match quantise(value, format.dec.count) {
        Some(units) => Ok(units),
        None => no_number(what, value, format),
    }
}

/// Converts units of a letter to a number, for messages and geometry.
pub fn as_number(units: i64, decimals: u8) -> f64 {
    units as f64 / POWERS[usize::from(decimals)] as f64
}

/// Checks that a code is not rounded: G59.1 printed as G59 is another work offset.
#[cold]
fn check_code(info: &Letter, value: f64, units: i64) -> Done {
    if (as_number(units, info.format.dec.count) - value).abs() < 1e-9 {
        return Ok(());
    }
    let letter = char::from(info.printed);
    let message = format!("{letter}{value} does not fit the format `{letter}{}`", info.format);
    fault(Code::PR002, message, "give the letter a format with a decimal, as `G >3~>1`")
}

#[cold]
fn no_number<T>(what: &str, value: f64, format: &LetterFormat) -> Done<T> {
    if value.is_finite() {
        return unprintable(Unprintable::Overflow, what, value, format);
    }
    fault(Code::PR004, format!("{what} would be {value}, which is not a number"), "check the job's numbers here")
}

/// Error: a value does not fit its format.
#[cold]
pub fn unprintable<T>(why: Unprintable, what: &str, value: f64, format: &LetterFormat) -> Done<T> {
    match why {
        Unprintable::Overflow => fault(
            Code::PR002,
            format!("{what} is {value}, but its format `{}` has {} digits before the point", format, format.int.count),
            "give the letter more digits, or check the number in the job",
        ),
        Unprintable::Negative => {
            let format = format.to_string();
            let format = format.trim_start();
            fault(
                Code::PR003,
                format!("{what} is {value}, but its format `{format}` has no sign"),
                format!("write `-` before the digits to allow negative values, as `-{format}`"),
            )
        }
    }
}

/// Relative rounding error of a feed that is accepted without a note.
pub const ROUNDED: f64 = 0.01;

/// Whether the relative rounding error of a printed value exceeds `part`.
pub fn loses(value: f64, printed: f64, part: f64) -> bool {
    (printed.abs() - value.abs()).abs() > value.abs() * part
}
