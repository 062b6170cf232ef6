//! The tolerance for comparing numbers in a form. Calculations have rounding errors: 12.7 mm are 0.49999999999999994
//! inches. In a form, this value must count as equal to .5.

use std::cmp::Ordering;

/// Absolute tolerance: a thousandth of the finest digit that a control reads.
const NEAR: f64 = 1e-9;

/// Relative tolerance, for numbers so large that their binary precision is coarser than the absolute tolerance.
const NEAR_OF_LARGE: f64 = 1e-12;

fn is_near(left: f64, right: f64) -> bool {
    (left - right).abs() <= NEAR.max(NEAR_OF_LARGE * left.abs().max(right.abs()))
}

/// The order of two numbers within the tolerance; `None` if one of them is NaN.
pub fn order(left: f64, right: f64) -> Option<Ordering> {
    if is_near(left, right) { Some(Ordering::Equal) } else { left.partial_cmp(&right) }
}

/// Whether a divisor is zero within the tolerance.
pub fn is_zero(value: f64) -> bool {
    is_near(value, 0.0)
}

/// The next lower whole number. A number within the tolerance of a whole number is rounded to this whole number.
pub fn floor(value: f64) -> f64 {
    let nearest = value.round();
    if is_near(value, nearest) { nearest } else { value.floor() }
}

/// The next higher whole number. A number within the tolerance of a whole number is rounded to this whole number.
pub fn ceil(value: f64) -> f64 {
    -floor(-value)
}

/// The nearest whole number. Halves are rounded away from zero.
pub fn round(value: f64) -> f64 {
    floor(value.abs() + 0.5).copysign(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_nothing() {
        let noisy = 12.7 * (1.0 / 25.4);
        assert!(noisy < 0.5);
        assert_eq!(order(noisy, 0.5), Some(Ordering::Equal));
        assert_eq!([floor(noisy * 2.0), ceil(0.1 + 0.2 - 0.3), round(noisy), round(-noisy)], [1.0, 0.0, 1.0, -1.0]);
        assert!(is_zero(0.3 - 0.2 - 0.1));
    }

    #[test]
    fn what_prints_otherwise_is_another_number() {
        for (less, more) in [(0.5, 0.500001), (-1.0, -0.999999), (1e9, 1e9 + 1.0), (0.0, 1e-6), (99999.9999, 100_000.0)]
        {
            assert_eq!(order(less, more), Some(Ordering::Less), "{less} {more}");
        }
        assert_eq!([floor(1e10 + 0.5), floor(-0.5), ceil(0.2), round(2.5), round(-2.5)], [1e10, -1.0, 1.0, 3.0, -3.0]);
        assert_eq!(order(f64::NAN, 1.0), None);
    }
}
