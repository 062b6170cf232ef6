//! Calculates the corners of `RND` and `CHF` between two lines.

use crate::diag::Code;
use crate::nc::fault::{Done, refuse};

/// A rounded or chamfered corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The point at which the first line now ends.
    pub start: [f64; 2],
    /// The point at which the second line now begins.
    pub end: [f64; 2],
    /// The centre of the arc, and whether the arc is counterclockwise; `None`: the corner is a chamfer.
    pub arc: Option<([f64; 2], bool)>,
}

impl Corner {
    /// The corner between the line from `from` to `at` and the line from `at` to `to`. `size` is the radius, or the
    /// length of a side of the chamfer.
    ///
    /// # Errors
    /// The lines are too short, or they don't meet at an angle.
    pub fn new(from: [f64; 2], at: [f64; 2], to: [f64; 2], size: f64, rounds: bool) -> Done<Corner> {
        let unit = |a: [f64; 2], b: [f64; 2]| {
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            ([(b[0] - a[0]) / length, (b[1] - a[1]) / length], length)
        };
        let ((u, before), (v, after)) = (unit(from, at), unit(at, to));
        let cross = u[0] * v[1] - u[1] * v[0];
        let dot = u[0] * v[0] + u[1] * v[1];
        if before.min(after) == 0.0 || cross.abs() < 1e-9 {
            return refuse(
                Code::PN009,
                "a rounding or chamfer without a corner",
                "write RND or CHF between two lines that meet at an angle",
            );
        }
        let cut = if rounds { size * (cross.atan2(dot) / 2.0).tan().abs() } else { size };
        if size <= 0.0 || cut > before.min(after) + 1e-9 {
            let message = format!("a rounding or chamfer of {size} is longer than an adjacent line");
            return refuse(Code::PN009, message, "use a smaller size, or longer lines");
        }
        let start = [at[0] - cut * u[0], at[1] - cut * u[1]];
        let end = [at[0] + cut * v[0], at[1] + cut * v[1]];
        let left = cross > 0.0;
        let side = if left { size } else { -size };
        let arc = rounds.then_some(([start[0] - side * u[1], start[1] + side * u[0]], left));
        Ok(Corner { start, end, arc })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_tangential() {
        let corner = Corner::new([0.0, 0.0], [20.0, 0.0], [20.0, 20.0], 3.0, true).unwrap();
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9;
        assert!(near(corner.start, [17.0, 0.0]) && near(corner.end, [20.0, 3.0]));
        assert!(corner.arc.is_some_and(|(center, left)| left && near(center, [17.0, 3.0])));
        let chamfer = Corner::new([0.0, 0.0], [20.0, 0.0], [20.0, -20.0], 2.0, false).unwrap();
        assert!(near(chamfer.start, [18.0, 0.0]) && near(chamfer.end, [20.0, -2.0]) && chamfer.arc.is_none());
        assert!(Corner::new([0.0, 0.0], [2.0, 0.0], [2.0, 20.0], 3.0, true).is_err());
        assert!(Corner::new([0.0, 0.0], [2.0, 0.0], [4.0, 0.0], 1.0, true).is_err());
    }
}
