//! An arc, or a helix.

use super::rates::Way;

/// An arc from the current position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// The axes of its plane.
    pub plane: [usize; 2],
    /// From its centre to its beginning, along those axes, in millimetres.
    pub from: [f64; 2],
    /// The angle that it turns, in radians, positive from the first axis to the second.
    pub sweep: f64,
    /// The travel of the axes outside of the plane.
    pub rise: Way,
}

/// How far chords may deviate from an arc: Grbl's `$12`, in millimetres.
const CHORD: f64 = 0.002;

impl Curve {
    pub(super) fn radius(&self) -> f64 {
        self.from[0].hypot(self.from[1])
    }

    /// Its length including its rise.
    pub fn length(&self) -> f64 {
        let rise: f64 = self.rise[..3].iter().map(|part| part * part).sum();
        (self.radius() * self.sweep).hypot(rise.sqrt())
    }

    /// The chords into which Grbl divides it: `mc_arc` in its motion_control.c.
    pub(super) fn chords(self) -> impl Iterator<Item = Way> {
        let radius = self.radius();
        let per_chord = (CHORD * (2.0 * radius - CHORD)).max(0.0).sqrt();
        let count = (0.5 * self.sweep.abs() * radius / per_chord).floor();
        // an arc smaller than the chord error is a line to its end
        let count = if count.is_finite() { count.max(1.0) } else { 1.0 };
        self.parts(count as u64)
    }

    /// A number of chords of the same length.
    pub(super) fn parts(self, count: u64) -> impl Iterator<Item = Way> {
        let share = 1.0 / count as f64;
        let at = move |part: f64| {
            let (sine, cosine) = (self.sweep * part * share).sin_cos();
            [self.from[0] * cosine - self.from[1] * sine, self.from[0] * sine + self.from[1] * cosine]
        };
        (0..count).map(move |chord| {
            let (begin, end) = (at(chord as f64), at((chord + 1) as f64));
            let mut way = self.rise.map(|rise| rise * share);
            for axis in 0..2 {
                way[self.plane[axis]] = end[axis] - begin[axis];
            }
            way
        })
    }
}
