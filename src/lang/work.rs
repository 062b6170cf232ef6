//! Work offsets as in jobs.

/// The form's code for a job's work offset. `first` is the form's first offset. A number below 50 is a fixture, counted
/// from 1; from 50 on it is the code itself. A form whose first offset is a small number (`G15 H1`, `E1`) uses 54 to 59
/// for its first six offsets, and has no other codes.
pub fn work_code(first: f64, work: f64) -> Option<f64> {
    const CODES: std::ops::RangeInclusive<f64> = 54.0..=59.0;
    match work {
        _ if (1.0..50.0).contains(&work) => Some(first + work - 1.0),
        _ if first >= 50.0 || work < 1.0 => Some(work),
        _ if CODES.contains(&work) && work.fract() == 0.0 => Some(first + work - CODES.start()),
        _ => None,
    }
}

/// The number of an additional offset, which is selected by a number after a code, such as `G54.1 P1` or `G154 P1`.
pub fn additional_work(number: f64) -> f64 {
    const FIRST: f64 = 1540.0;
    FIRST + number
}
