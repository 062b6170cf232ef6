//! Chamfers and rounded corners of G1, from the section "Chamfering and corner R" of FANUC's manual (B-64304EN 4.4) and the pages of
//! Haas's lathe manual for G01.

use super::executor::{Kind, Machine, Point, Stopped, Words, alarm, unsure};

const NEAR: f64 = 1e-9;

/// A corner that was cut, with the data for the next block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// The programmed corner point, from which the increments of the next block start.
    pub(super) at: Point,
    /// The axis of the next block.
    axis: usize,
    /// Length that the corner takes from the next block, with the sign of the direction.
    size: f64,
}

/// The cut up to the corner, the chamfer or arc, and the data for the next block.
pub(super) type Cornered = ([(Kind, Point); 2], Corner);

/// The axis of a block that moves along only one axis.
fn only_axis(words: &Words) -> Option<usize> {
    match (words.any(['X', 'U']), words.any(['Z', 'W'])) {
        (true, false) => Some(0),
        (false, true) => Some(1),
        _ => None,
    }
}

impl Machine<'_> {
    /// The moves of a straight cut with I, K or R; `None`: the block contains none of these words.
    pub(super) fn cornered(&self, words: &Words, from: Point, to: Point) -> Result<Option<Cornered>, Stopped> {
        let said: Vec<(char, f64)> = ['I', 'K', 'R']
            .iter()
            .filter_map(|&letter| words.length(letter, self.unit).map(|size| (letter, size)))
            .collect();
        let (letter, size) = match said[..] {
            [] => return Ok(None),
            [one] => one,
            // PS0053
            _ => return alarm("two of I, K and R"),
        };
        let Some(axis) = only_axis(words) else {
            let moved = [0, 1].iter().filter(|&&axis| (to[axis] - from[axis]).abs() > NEAR).count();
            // PS0054
            return if moved == 2 { alarm("a corner after a taper") } else { unsure("a corner and both axes") };
        };
        if (letter, axis) == ('I', 0) || (letter, axis) == ('K', 1) {
            return alarm("I with X, or K with Z");
        }
        if size == 0.0 {
            return unsure("a corner of nothing");
        }
        let (next, way) = (1 - axis, to[axis] - from[axis]);
        if way.is_nan() || to[next].is_nan() {
            return unsure("a corner from where only the machine knows");
        }
        // PS0055
        if way.abs() < size.abs() - NEAR {
            return alarm("a cut shorter than its corner");
        }
        let (mut begin, mut end) = (to, to);
        begin[axis] -= way.signum() * size.abs();
        end[next] += size;
        let kind = if letter == 'R' {
            let mut center = begin;
            center[next] += size;
            // counter-clockwise, with Z to the right and X up: the path turns to the left
            let left = if axis == 1 { way * size > 0.0 } else { way * size < 0.0 };
            Kind::Arc(center, left)
        } else {
            Kind::Feed
        };
        Ok(Some(([(Kind::Feed, begin), (kind, end)], Corner { at: to, axis: next, size })))
    }
}

impl Corner {
    /// Checks that this block leaves the corner correctly. The block must be a G1 along the other axis alone, in the
    /// corner's direction, and at least as long as the corner.
    pub(super) fn is_left(&self, words: &Words, motion: f64, to: Point) -> Result<(), Stopped> {
        // PS0051
        if motion != 1.0 || only_axis(words) != Some(self.axis) {
            return alarm("a corner that the next block does not leave");
        }
        let way = to[self.axis] - self.at[self.axis];
        // PS0052, PS0055
        if way * self.size.signum() < self.size.abs() - NEAR {
            return alarm("a block after a corner that is too short or goes the other way");
        }
        Ok(())
    }
}
