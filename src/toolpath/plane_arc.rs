//! Arcs in their plane, and how they are divided: at quadrants, into equal parts, into chords.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Tolerance within which two angles are equal, in radians.
const SAME_ANGLE: f64 = 1e-9;

/// An arc in two dimensions, in the coordinates of its plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneArc {
    /// Centre.
    pub centre: [f64; 2],
    /// Radius.
    pub radius: f64,
    /// Angle of the start, in radians.
    pub start: f64,
    /// Angle from start to end, positive counter-clockwise. The angle of a helix with several turns is more than a full
    /// turn.
    pub sweep: f64,
}

impl PlaneArc {
    /// The arc from `from` to `to` around `centre`. If start and end are equal, the arc is a full circle. `turns` full
    /// turns are added.
    pub fn new(from: [f64; 2], to: [f64; 2], centre: [f64; 2], ccw: bool, turns: u32) -> PlaneArc {
        let angle = |p: [f64; 2]| (p[1] - centre[1]).atan2(p[0] - centre[0]);
        let (start, end) = (angle(from), angle(to));
        let radius = (from[0] - centre[0]).hypot(from[1] - centre[1]);
        let mut sweep = if ccw { end - start } else { start - end };
        if sweep < 0.0 {
            sweep += TAU;
        }
        let closed = (to[0] - from[0]).hypot(to[1] - from[1]) <= radius * SAME_ANGLE;
        if closed {
            sweep = TAU;
        }
        sweep += f64::from(turns) * TAU;
        PlaneArc { centre, radius, start, sweep: if ccw { sweep } else { -sweep } }
    }

    /// The centre of an arc with this radius. If the radius is negative, the longer arc is meant. `None`: start and end
    /// are equal, or farther apart than the diameter.
    pub fn centre_by_radius(from: [f64; 2], to: [f64; 2], radius: f64, ccw: bool) -> Option<[f64; 2]> {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let half = dx.hypot(dy) / 2.0;
        if half == 0.0 {
            return None;
        }
        let square = radius * radius - half * half;
        // allow a half circle whose rounded radius is a little too small
        if square < 0.0 && half > radius.abs() * (1.0 + 1e-6) + 1e-6 {
            return None;
        }
        let height = square.max(0.0).sqrt();
        // the centre of the shorter counter-clockwise arc is on the left side of the chord
        let side = if ccw == (radius > 0.0) { 1.0 } else { -1.0 };
        let (nx, ny) = (-dy / (2.0 * half), dx / (2.0 * half));
        Some([(from[0] + to[0]) / 2.0 + side * height * nx, (from[1] + to[1]) / 2.0 + side * height * ny])
    }

    /// The point at a fraction of the arc, from 0 to 1.
    pub fn point(&self, part: f64) -> [f64; 2] {
        let (sin, cos) = (self.start + self.sweep * part).sin_cos();
        [self.centre[0] + self.radius * cos, self.centre[1] + self.radius * sin]
    }

    /// The fractions of the arc at which it crosses quadrants, without 0 and 1.
    pub fn quadrant_parts(&self, parts: &mut Vec<f64>) {
        let direction = self.sweep.signum();
        let first = self.start * direction / FRAC_PI_2;
        let mut line = (first + SAME_ANGLE).floor() + 1.0;
        loop {
            let part = (line - first) * FRAC_PI_2 / self.sweep.abs();
            if part >= 1.0 - SAME_ANGLE {
                return;
            }
            if part > SAME_ANGLE {
                parts.push(part);
            }
            line += 1.0;
        }
    }

    /// The fractions that divide the arc into equal parts of at most `most` radians.
    pub fn equal_parts(&self, most: f64, parts: &mut Vec<f64>) {
        let count = (self.sweep.abs() / most - SAME_ANGLE).ceil().max(1.0);
        parts.extend((1..count as u64).map(|i| i as f64 / count));
    }

    /// The largest angle of a chord that stays within `tolerance` of the arc.
    pub fn chord_angle(&self, tolerance: f64) -> f64 {
        if tolerance >= self.radius {
            return PI / 2.0;
        }
        (2.0 * (1.0 - tolerance / self.radius).acos()).clamp(1e-4, PI / 2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn sweeps_and_full_circles() {
        let quarter = PlaneArc::new([1.0, 0.0], [0.0, 1.0], [0.0, 0.0], true, 0);
        assert!((quarter.sweep - FRAC_PI_2).abs() < 1e-12);
        let other_way = PlaneArc::new([1.0, 0.0], [0.0, 1.0], [0.0, 0.0], false, 0);
        assert!((other_way.sweep + 3.0 * FRAC_PI_2).abs() < 1e-12);
        assert_eq!(PlaneArc::new([1.0, 0.0], [1.0, 0.0], [0.0, 0.0], false, 1).sweep, -2.0 * TAU);
    }

    #[test]
    fn quadrant_lines_cut_both_ways_round() {
        let parts = |arc: PlaneArc| {
            let mut parts = Vec::new();
            arc.quadrant_parts(&mut parts);
            parts.iter().map(|p| (p * 1000.0).round() / 1000.0).collect::<Vec<_>>()
        };
        let circle = PlaneArc::new([1.0, 0.0], [1.0, 0.0], [0.0, 0.0], true, 0);
        assert_eq!(parts(circle), [0.25, 0.5, 0.75]);
        assert_eq!(parts(PlaneArc { sweep: -TAU, ..circle }), [0.25, 0.5, 0.75]);
        assert_eq!(parts(PlaneArc { start: PI / 4.0, sweep: -PI / 2.0, ..circle }), [0.5]);
        assert!(parts(PlaneArc { sweep: FRAC_PI_2, ..circle }).is_empty());
    }

    proptest! {
        /// A centre that is calculated from a radius has the distance of this radius from both ends. The arc is the
        /// requested one of the two possible arcs.
        #[test]
        fn radius_arcs_close(x in -10.0..10.0f64, y in -10.0..10.0f64, stretch in 1.001..5.0f64, ccw: bool, long: bool) {
            prop_assume!(x.hypot(y) > 0.01);
            let radius = x.hypot(y) / 2.0 * stretch * if long { -1.0 } else { 1.0 };
            let centre = PlaneArc::centre_by_radius([0.0, 0.0], [x, y], radius, ccw).unwrap();
            let arc = PlaneArc::new([0.0, 0.0], [x, y], centre, ccw, 0);
            let end = arc.point(1.0);
            prop_assert!((end[0] - x).hypot(end[1] - y) < 1e-9);
            prop_assert!((arc.radius - radius.abs()).abs() < 1e-9);
            prop_assert_eq!(arc.sweep.abs() > PI, long);
        }
    }
}
