//! Functions that the cycles of several languages share: strokes of pecks, and dwells.

use crate::diag::Code;
use crate::nc::call::Step;
use crate::nc::fault::{Done, refuse};

/// The maximum number of strokes of one hole.
const MOST: usize = 100_000;

/// The depths at which the strokes of a hole end. The last depth is the bottom. `next` returns the length of the next
/// stroke; its arguments are the length of this stroke and the remaining depth.
///
/// # Errors
/// A stroke has a length of zero, or there are too many strokes.
pub fn depths(from: f64, bottom: f64, first: f64, next: impl Fn(f64, f64) -> f64) -> Done<Vec<f64>> {
    let (mut depths, mut depth, mut stroke) = (Vec::new(), from, first);
    loop {
        // a remainder that comes from rounding is not a separate stroke
        if depth - stroke <= bottom + 1e-9 {
            depths.push(bottom);
            return Ok(depths);
        }
        if stroke.is_nan() || stroke <= 0.0 {
            return refuse(Code::PN018, format!("a peck of {stroke}"), "write a peck greater than zero");
        }
        if depths.len() == MOST {
            return refuse(Code::PN018, format!("more than {MOST} pecks in a hole"), "write a larger peck");
        }
        depth -= stroke;
        depths.push(depth);
        stroke = next(stroke, depth - bottom);
    }
}

/// A dwell step, unless the time is zero.
pub fn dwell(seconds: f64) -> Option<Step> {
    (seconds > 0.0).then_some(Step::Dwell(seconds))
}
