//! Random profiles, and the cycles that rough and finish them.

use std::fmt::Write;

use super::contour::Between;
use super::program::Writer;

/// A block of a profile: its end, relative to its start, and its arc.
struct Block {
    to: [i64; 2],
    arc: Option<Round>,
}

struct Round {
    ccw: bool,
    /// Centre relative to the start.
    center: Option<[i64; 2]>,
    radius: i64,
}

/// A profile with its start.
pub(super) struct Profile {
    code: u32,
    start: [i64; 2],
    first: [i64; 2],
    blocks: Vec<Block>,
    /// The axis across the passes, and the signs of the direction to the bottom and of the cut.
    level: usize,
    toward: i64,
    cutting: i64,
}

impl Profile {
    pub(super) fn random(writer: &mut Writer) -> Profile {
        let code = writer.random.pick(&[71, 71, 72, 73]);
        let level = if code == 72 { 1 } else { 0 };
        let along = 1 - level;
        // outside or inside, from the face or from the other side
        let (toward, cutting) = match level {
            0 => (writer.random.pick(&[-1, -1, 1]), writer.random.pick(&[-1, -1, -1, -1, 1])),
            _ => (writer.random.pick(&[-1, -1, -1, 1]), writer.random.pick(&[-1, -1, -1, 1])),
        };
        let mut start = [writer.steps(20, 45, 1000), writer.steps(0, 6, 1000)];
        if writer.once_in(12) {
            // the cut reaches the axis of the part, and beyond
            start[0] = 9000;
        }
        let mut blocks = Vec::new();
        let mut at = [0i64, 0];
        for _ in 0..2 + writer.random.below(5) {
            let up = writer.steps(0, 8, 500);
            let on = writer.steps(0, 16, 500);
            let begin = at;
            match writer.random.below(7) {
                0 if up > 0 => {
                    at = [at[0] + up, at[1] + up];
                    let convex = writer.once_in(2);
                    let center = if convex { [0, up] } else { [up, 0] };
                    blocks.push((begin, at, Some((center, up, true))));
                }
                1 if up > 0 && on > 0 => {
                    at = [at[0] + up, at[1] + on];
                    let (a, b) = (up as f64, on as f64);
                    let radius = ((a * a + b * b) / (2.0 * a.min(b)) * 1.05).ceil() as i64 + 10;
                    let side = writer.random.pick(&[1, -1]);
                    blocks.push((begin, at, Some(([side, 0], radius, false))));
                }
                // a step along one axis, then along the other
                5 if up > 0 && on > 0 => {
                    let corner = if writer.once_in(2) { [at[0] + up, at[1]] } else { [at[0], at[1] + on] };
                    at = [at[0] + up, at[1] + on];
                    blocks.extend([(begin, corner, None), (corner, at, None)]);
                }
                2 if up > 0 => {
                    at[0] += up;
                    blocks.push((begin, at, None));
                }
                3 if up > 0 && on > 0 => {
                    at = [at[0] + up, at[1] + on];
                    blocks.push((begin, at, None));
                }
                _ if on > 0 => {
                    at[1] += on;
                    blocks.push((begin, at, None));
                }
                _ => {}
            }
        }
        // the start is at the height where the profile ends, above it, or below it
        let high = at[0] + writer.random.pick(&[0, 0, 0, 500, 1000, -500]);
        let high = high.max(500);
        let mut first = start;
        first[level] += toward * high;
        let map = |point: [i64; 2]| {
            let mut to = first;
            to[level] -= toward * point[0];
            to[along] += cutting * point[1];
            to
        };
        let vector = |point: [i64; 2]| {
            let mut to = [0, 0];
            to[level] = -toward * point[0];
            to[along] = cutting * point[1];
            to
        };
        let blocks = blocks
            .into_iter()
            .map(|(begin, end, arc)| {
                let to = map(end);
                let from = map(begin);
                let arc = arc.map(|(center, radius, quarter)| {
                    let way = [to[0] - from[0], to[1] - from[1]];
                    if quarter {
                        let center = vector(center);
                        let (a, b) = ([-center[0], -center[1]], [way[0] - center[0], way[1] - center[1]]);
                        Round { ccw: a[1] * b[0] - a[0] * b[1] > 0, center: Some(center), radius }
                    } else {
                        Round { ccw: center[0] > 0, center: None, radius }
                    }
                });
                Block { to, arc }
            })
            .collect();
        Profile { code, start, first, blocks, level, toward, cutting }
    }

    pub(super) fn write(self, writer: &mut Writer) {
        writer.kinds.push(match self.code {
            71 => "G71",
            72 => "G72",
            _ => "G73",
        });
        writer.rapid(self.start);
        let (p, q) = (writer.number, writer.number + 10 * self.blocks.len() as u32);
        writer.number = q + 10;
        let depth = writer.steps(2, 12, 250);
        // the allowance: away from the part, zero, or rarely into the part
        let mut left = [writer.steps(0, 4, 100), writer.steps(0, 3, 100)];
        let along = 1 - self.level;
        left[self.level] *= -self.toward;
        left[along] *= -self.cutting;
        for each in &mut left {
            if writer.once_in(16) {
                *each = -*each;
            }
        }
        let named = |writer: &mut Writer, letter: char, value: i64| match value {
            0 if writer.once_in(2) => String::new(),
            value => format!("{letter}{}", writer.length(value)),
        };
        let left = named(writer, 'U', left[0] * 2) + &named(writer, 'W', left[1]);
        let back = writer.steps(1, 4, 250);
        let feed = writer.feed();
        let mut last = format!("G{}P{p}Q{q}{left}", self.code);
        if self.code == 73 {
            let times = 2 + writer.random.below(3);
            let mut by = [0, 0];
            by[self.level] = -self.toward * writer.steps(0, 6, 500);
            by[along] = -self.cutting * writer.steps(0, 6, 500);
            if writer.haas {
                _ = write!(last, "I{}K{}D{times}", writer.length(by[0]), writer.length(by[1]));
            } else {
                let line = format!("G73U{}W{}R{times}", writer.length(by[0]), writer.length(by[1]));
                writer.line(&line);
            }
        } else if writer.haas {
            _ = write!(last, "D{}", writer.length(depth));
        } else {
            let letter = if self.code == 71 { 'U' } else { 'W' };
            let line = format!("G{}{letter}{}R{}", self.code, writer.length(depth), writer.length(back));
            writer.line(&line);
        }
        writer.line(&(last + &feed));
        self.blocks(writer, p, q);
        writer.at = self.start;
        if writer.once_in(3) {
            return writer.after_cycle();
        }
        writer.kinds.push("G70");
        let other = writer.once_in(3);
        if other {
            writer.line("G28U0W0");
            writer.line("T0404");
            writer.line("G97S1500M3");
            writer.rapid(self.start);
        }
        for _ in 0..if writer.once_in(8) { 2 } else { 1 } {
            let feed = if writer.once_in(2) { "F.1" } else { "" };
            put!(writer, "G70P{p}Q{q}{feed}");
        }
        writer.after_cycle();
    }

    fn blocks(&self, writer: &mut Writer, p: u32, q: u32) {
        let rapid = if writer.once_in(3) { "G1" } else { "G0" };
        // an unchanged axis has no word, because the word would make the profile one of type II
        let mut words = String::new();
        for (axis, letters) in [(0, ['X', 'U']), (1, ['Z', 'W'])] {
            if self.first[axis] != self.start[axis] {
                let by = if axis == 0 { 2 } else { 1 };
                let from_start = writer.once_in(4);
                let value = if from_start { self.first[axis] - self.start[axis] } else { self.first[axis] };
                _ = write!(words, "{}{}", letters[usize::from(from_start)], writer.length(value * by));
            }
        }
        let feed = if writer.once_in(3) { "F.12" } else { "" };
        put!(writer, "N{p}{rapid}{words}{feed}");
        let (mut at, mut motion, mut taken) = (self.first, rapid, 0);
        for (block, n) in self.blocks.iter().zip(1..) {
            // a corner, if this block and the next one each move along one axis
            let mut corner = (String::new(), 0);
            if let (Some((axis, first)), Some(Some((other, next)))) =
                (along_one(at, block), self.blocks.get(n as usize).map(|next| along_one(block.to, next)))
                && axis != other
                && !writer.once_in(4)
            {
                corner = writer.corner(&Between { axis, first, taken, next }).unwrap_or_default();
            }
            let lone = along_one(at, block).filter(|_| taken > 0 || corner.1 > 0).map(|(axis, _)| axis);
            let number = if n as usize == self.blocks.len() || writer.once_in(2) {
                format!("N{}", p + 10 * n)
            } else {
                String::new()
            };
            debug_assert!(n as usize != self.blocks.len() || p + 10 * n == q);
            let (code, words) = match &block.arc {
                None if lone.is_some() => ("G1", writer.alone(lone.unwrap_or(0), at, block.to) + &corner.0),
                None => ("G1", writer.words_to(at, block.to)),
                Some(round) => {
                    let words = writer.words_to(at, block.to);
                    let center = match round.center {
                        Some(center) if !writer.once_in(3) => {
                            let mut text = String::new();
                            for (letter, value) in [('I', center[0]), ('K', center[1])] {
                                if value != 0 || writer.once_in(3) {
                                    _ = write!(text, "{letter}{}", writer.length(value));
                                }
                            }
                            text
                        }
                        _ => format!("R{}", writer.length(round.radius)),
                    };
                    (if round.ccw { "G3" } else { "G2" }, words + &center)
                }
            };
            let shown = if code == motion && code == "G1" && writer.once_in(2) { "" } else { code };
            let feed = if writer.once_in(8) { "F.08" } else { "" };
            let speed = if writer.once_in(20) { "S900" } else { "" };
            put!(writer, "{number}{shown}{words}{feed}{speed}");
            (at, motion, taken) = (block.to, code, corner.1);
        }
    }
}

/// The axis of a straight block along one axis, and its length.
fn along_one(from: [i64; 2], block: &Block) -> Option<(usize, i64)> {
    let way = [block.to[0] - from[0], block.to[1] - from[1]];
    match (way, &block.arc) {
        ([0, z], None) if z != 0 => Some((1, z)),
        ([x, 0], None) if x != 0 => Some((0, x)),
        _ => None,
    }
}
