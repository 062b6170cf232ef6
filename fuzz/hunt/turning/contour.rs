//! Random contours with chamfers and rounded corners, or with cutter compensation.

use super::program::Writer;

/// The corner takes the whole length of a cut.
pub const EXACT: &str = "a corner as long as its cut";

/// A corner between a cut along `axis` and the next cut: the lengths of both (with sign), and the length that the
/// previous corner took.
pub(super) struct Between {
    pub(super) axis: usize,
    pub(super) first: i64,
    pub(super) taken: i64,
    pub(super) next: i64,
}

impl Writer {
    /// A word along one axis, absolute or incremental.
    pub(super) fn alone(&mut self, axis: usize, from: [i64; 2], to: [i64; 2]) -> String {
        let by = if axis == 0 { 2 } else { 1 };
        let (letter, value) = match (axis, self.once_in(3)) {
            (0, false) => ('X', to[0]),
            (0, true) => ('U', to[0] - from[0]),
            (_, false) => ('Z', to[1]),
            _ => ('W', to[1] - from[1]),
        };
        format!("{letter}{}", self.length(value * by))
    }

    /// The word of a corner, and the length that it takes from the next cut.
    pub(super) fn corner(&mut self, between: &Between) -> Option<(String, i64)> {
        let Between { axis, first, taken, next } = *between;
        let room = (first.abs() - taken).min(next.abs());
        let size = match self.random.below(40) {
            // larger than the cuts allow
            0 => room + 100,
            1..=2 => room,
            _ => (self.steps(1, 8, 100)).min(room),
        };
        if size <= 0 {
            return None;
        }
        if size == room {
            self.kinds.push(EXACT);
        }
        let letter = match (self.once_in(2), axis) {
            (true, _) => 'R',
            (false, 0) => 'K',
            _ => 'I',
        };
        let other_way = self.once_in(60);
        let signed = size * next.signum() * if other_way { -1 } else { 1 };
        Some((format!("{letter}{}", self.length(signed)), size))
    }

    /// Writes cuts along alternating axes, with corners between them.
    pub(super) fn corners(&mut self, start: [i64; 2]) {
        self.kinds.push("corners");
        self.rapid(start);
        let first_axis = self.random.below(2);
        let ways: Vec<i64> = (0..2 + self.random.below(4))
            .map(|_| {
                let size = self.steps(1, 40, 100);
                if self.once_in(3) { size } else { -size }
            })
            .collect();
        let feed = self.feed();
        let mut taken = 0;
        for (n, &way) in ways.iter().enumerate() {
            let axis = (first_axis + n) % 2;
            let mut to = self.at;
            to[axis] += way;
            let word = self.alone(axis, self.at, to);
            let next = ways.get(n + 1).copied().unwrap_or(0);
            let between = Between { axis, first: way, taken, next };
            let corner = if self.once_in(4) { None } else { self.corner(&between) };
            let code = if n == 0 || self.once_in(3) { "G1" } else { "" };
            let feed = match n {
                0 => feed.clone(),
                _ if self.once_in(6) => self.feed(),
                _ => String::new(),
            };
            let (corner, size) = corner.unwrap_or_default();
            put!(self, "{code}{word}{corner}{feed}");
            if size > 0 && self.once_in(10) {
                self.line("(A CORNER)");
            }
            (self.at, taken) = (to, size);
        }
    }

    /// Writes cuts with cutter compensation, the tool nose on one side.
    pub(super) fn beside(&mut self, start: [i64; 2], cuts: impl Fn(&mut Writer, [i64; 2])) {
        self.kinds.push("G41");
        let side = self.random.pick(&[41, 42]);
        self.rapid([start[0] + 2000, start[1] + 2000]);
        if self.once_in(3) {
            put!(self, "G{side}");
        } else {
            let words = self.words_to(self.at, [start[0] + 1000, start[1] + 1000]);
            let code = self.random.pick(&["G0", "G0", "G1F.2"]);
            put!(self, "G{side}{code}{words}");
        }
        cuts(self, start);
        let to = [self.at[0] + 1000, self.at[1]];
        let words = self.words_to(self.at, to);
        let ends = self.random.pick(&["G40G0", "G0G40", "G40\nG0"]);
        put!(self, "{ends}{words}");
        self.at = to;
    }
}
