//! Work offsets as jobs name them.

/// A job's work offset as a form counts it, whose first one is `first`: a number below 50 counts fixtures from 1, from 50
/// on it is the code itself. A form that counts from a small number (`G15 H1`, `E1`) takes 54 to 59 for its first six;
/// other codes it does not have.
pub fn work_code(first: f64, work: f64) -> Option<f64> {
    const CODES: std::ops::RangeInclusive<f64> = 54.0..=59.0;
    match work {
        _ if (1.0..50.0).contains(&work) => Some(first + work - 1.0),
        _ if first >= 50.0 || work < 1.0 => Some(work),
        _ if CODES.contains(&work) && work.fract() == 0.0 => Some(first + work - CODES.start()),
        _ => None,
    }
}

/// What an offset is called that is selected by its number after a code, as `G54.1 P1` or `G154 P1`.
pub fn additional_work(number: f64) -> f64 {
    const FIRST: f64 = 1540.0;
    FIRST + number
}
