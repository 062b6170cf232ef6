//! Numbers and codes of work offsets.

/// The form's code for a work offset of a job. `first` is the code of the form's first offset. A number below 50 is the
/// number of a fixture, counted from 1. A number of 50 or more is the code itself. If the form's first offset is a
/// small number, as in `G15 H1` or `E1`, the codes 54 to 59 select the first six offsets. `None`: the form has no code
/// for this offset.
pub fn work_code(first: f64, work: f64) -> Option<f64> {
    const CODES: std::ops::RangeInclusive<f64> = 54.0..=59.0;
    match work {
        _ if (1.0..50.0).contains(&work) => Some(first + work - 1.0),
        _ if first >= 50.0 || work < 1.0 => Some(work),
        _ if CODES.contains(&work) && work.fract() == 0.0 => Some(first + work - CODES.start()),
        _ => None,
    }
}

/// The number that represents an additional offset inside postform. A control selects an additional offset by a number
/// after a code, as in `G54.1 P1` or `G154 P1`.
pub fn additional_work(number: f64) -> f64 {
    const FIRST: f64 = 1540.0;
    FIRST + number
}
