//! An arc, or a helix.

use super::rates::Way;

/// An arc from the current position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// The two axes of the plane of the arc.
    pub plane: [usize; 2],
    /// The vector from the centre of the arc to its beginning, along these axes, in millimetres.
    pub from: [f64; 2],
    /// The angle of the arc in radians, positive from the first axis to the second.
    pub sweep: f64,
    /// The travel of the axes outside the plane of the arc.
    pub rise: Way,
}

/// Greatest distance of a chord from its arc, in millimetres: `$12` of Grbl.
const CHORD: f64 = 0.002;

impl Curve {
    pub(super) fn radius(&self) -> f64 {
        self.from[0].hypot(self.from[1])
    }

    /// The length of the arc, including its rise.
    pub fn length(&self) -> f64 {
        let rise: f64 = self.rise[..3].iter().map(|part| part * part).sum();
        (self.radius() * self.sweep).hypot(rise.sqrt())
    }

    /// The chords into which Grbl divides the arc: see `mc_arc` in Grbl's motion_control.c.
    pub(super) fn chords(self) -> impl Iterator<Item = Way> {
        let radius = self.radius();
        let per_chord = (CHORD * (2.0 * radius - CHORD)).max(0.0).sqrt();
        let count = (0.5 * self.sweep.abs() * radius / per_chord).floor();
        // if the arc is smaller than the chord error, it becomes one line to its end
        let count = if count.is_finite() { count.max(1.0) } else { 1.0 };
        self.parts(count as u64)
    }

    /// Divides the arc into chords of the same length.
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
