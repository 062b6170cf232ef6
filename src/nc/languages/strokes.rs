//! Parts that cycles of several languages share: strokes of pecks, dwells.

use crate::diag::Code;
use crate::nc::call::Step;
use crate::nc::fault::{Done, refuse};

/// The largest number of strokes of one hole.
const MOST: usize = 100_000;

/// The depths at which strokes end. The last one is the bottom. `next` returns the length of the next stroke from the
/// length of this one and the remaining depth.
///
/// # Errors
/// A stroke has no length, or there are too many.
pub fn depths(from: f64, bottom: f64, first: f64, next: impl Fn(f64, f64) -> f64) -> Done<Vec<f64>> {
    let (mut depths, mut depth, mut stroke) = (Vec::new(), from, first);
    loop {
        // a rest from rounding of decimals is not a stroke
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
