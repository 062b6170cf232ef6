//! Pieces of arcs, ready to print.

use std::f64::consts::PI;

use crate::sema;
use crate::toolpath::{Axes, PlaneArc};

/// An arc or a part of it, ready to print.
pub struct Piece<'a> {
    /// The two axes of the plane, in the order in which counter-clockwise angles are positive.
    pub axes: [usize; 2],
    /// The code of the plane.
    pub plane: &'a sema::Code,
    /// The arc of this piece, in the coordinates of the plane.
    pub arc: PlaneArc,
    /// Position at which the piece ends.
    pub target: Axes,
}

impl Piece<'_> {
    /// The part of the arc between two fractions of its sweep. The arc begins at `from`.
    pub fn part(&self, from: &Axes, done: f64, part: f64, across: usize) -> Piece<'_> {
        let arc = &self.arc;
        let mut target = *from;
        if part == 1.0 {
            target = self.target;
        } else {
            // after whole turns the point equals the start in every digit, so that a full turn stays an arc
            let turns = arc.sweep * part / (2.0 * PI);
            if (turns - turns.round()).abs() > 1e-9 {
                let point = arc.point(part);
                target.values[self.axes[0]] = point[0];
                target.values[self.axes[1]] = point[1];
            }
            let rise = self.target.values[across] - from.values[across];
            target.values[across] = from.values[across] + rise * part;
        }
        let piece = PlaneArc { start: arc.start + arc.sweep * done, sweep: arc.sweep * (part - done), ..*arc };
        Piece { axes: self.axes, plane: self.plane, arc: piece, target }
    }
}
