//! Parts that cycles of several languages have: strokes of pecks, dwells.

use crate::diag::Code;
use crate::nc::call::Step;
use crate::nc::fault::{Done, refuse};

/// Most strokes of one hole.
const MOST: usize = 100_000;

/// The depths at which strokes end, the last at the bottom. `next`: the length of the stroke after one of this length, with
/// so much left.
///
/// # Errors
/// A stroke of no length, or too many of them.
pub fn depths(from: f64, bottom: f64, first: f64, next: impl Fn(f64, f64) -> f64) -> Done<Vec<f64>> {
    let (mut depths, mut depth, mut stroke) = (Vec::new(), from, first);
    loop {
        // what is left of a sum of decimals is no stroke
        if depth - stroke <= bottom + 1e-9 {
            depths.push(bottom);
            return Ok(depths);
        }
        if stroke.is_nan() || stroke <= 0.0 {
            return refuse(Code::PN018, format!("a peck of {stroke}"), "write a peck greater than zero");
        }
        if depths.len() == MOST {
            return refuse(Code::PN018, format!("over {MOST} pecks in a hole"), "write a larger peck");
        }
        depth -= stroke;
        depths.push(depth);
        stroke = next(stroke, depth - bottom);
    }
}

/// A dwell, where it has a length.
pub fn dwell(seconds: f64) -> Option<Step> {
    (seconds > 0.0).then_some(Step::Dwell(seconds))
}
