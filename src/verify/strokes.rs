//! Counts the strokes in a hole by the same rules for the pecks of the job and of the program.

use super::cut::number;
use super::tables::{LEFT, LONGER};

/// The strokes of a hole so far. A stroke ends when the tool leaves the bottom of the hole, so a stroke may consist of
/// several blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Strokes {
    /// The height where the feed begins.
    plane: f64,
    /// The lowest height so far.
    pub deepest: f64,
    /// The greatest height since the tool was at its lowest height.
    highest: f64,
    /// The height where the last stroke began to cut.
    begun: f64,
    /// The depth of the hole when the tool last left it.
    out: f64,
    /// The number of all strokes, and the number of strokes that began after the tool had left the hole.
    pub counts: [u64; 2],
    /// The two numbers in `counts` before the last stroke.
    earlier: [u64; 2],
    /// The longest stroke.
    pub longest: f64,
    /// The longest cut between two retracts out of the hole, measured along the hole.
    pub farthest: f64,
}

impl Strokes {
    /// The state before the first stroke in a hole whose feed begins at this height.
    pub fn over(plane: f64) -> Strokes {
        Strokes { plane, deepest: plane, highest: plane, begun: plane, out: plane, ..Strokes::default() }
    }

    /// Moves the tool to a height at rapid.
    pub fn comes_to(&mut self, height: f64) {
        self.highest = self.highest.max(height);
    }

    /// Feeds to a height. `increment`: the smallest step that the form can print along the hole, in the job's units.
    pub fn cut(&mut self, to: f64, increment: f64, tolerance: f64) {
        self.comes_to(to);
        if to >= self.deepest {
            return;
        }
        let [count, outs] = self.counts;
        // half a step of the form allows for binary rounding
        if count == 0 || self.highest - self.deepest > increment / 2.0 {
            let is_out = count > 0 && self.highest >= self.plane - tolerance;
            (self.earlier, self.counts) = (self.counts, [count + 1, outs + u64::from(is_out)]);
            self.begun = self.deepest;
            if is_out {
                self.out = self.deepest;
            }
        }
        self.longest = self.longest.max(self.begun - to);
        self.farthest = self.farthest.max(self.out - to);
        (self.deepest, self.highest) = (to, to);
    }

    /// The counts of strokes. The last stroke is not counted if it cuts only a small remainder.
    pub fn counted(&self, tolerance: f64) -> [u64; 2] {
        let last = self.begun - self.deepest;
        if last > (LEFT * self.longest).max(2.0 * tolerance) { self.counts } else { self.earlier }
    }
}

/// The reason why other pecks than required do not make the same hole. Each reason has the greatest depths that are made
/// and required.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lost {
    /// One peck is too deep, or the hole is drilled in one stroke.
    Pecks([f64; 2]),
    /// The tool cuts too deep before it retracts out of the hole.
    Retracts([f64; 2]),
    /// The tool never retracts out of the hole, so it only breaks the chips. The required depth between two retracts.
    AllRetracts(f64),
}

impl Lost {
    /// The difference as text. `other`: the name of the required pecks, such as `the job`.
    pub fn text(self, other: &str) -> String {
        match self {
            Lost::Pecks([is, by]) => format!("one peck is {} deep, but at most {} in {other}", number(is), number(by)),
            Lost::Retracts([is, by]) => {
                let (is, by) = (number(is), number(by));
                format!("the tool cuts {is} deep before it retracts out of the hole, but {by} in {other}")
            }
            Lost::AllRetracts(by) => format!(
                "the tool only breaks the chips, but in {other} it retracts out of the hole after every {} of depth",
                number(by)
            ),
        }
    }
}

/// Whether the strokes `made` retract out of the hole, but the strokes `wanted` only break the chips.
pub(super) fn retracts_instead(wanted: &Strokes, made: &Strokes) -> bool {
    wanted.counts[0] > 1 && wanted.counts[1] == 0 && made.counts[1] > 0
}

/// Whether the strokes `made` do not replace the strokes `wanted`. If the wanted strokes peck, the other strokes must
/// also peck. `comes_out`: the other strokes must also leave the hole as often.
pub(super) fn lost(wanted: &Strokes, made: &Strokes, comes_out: bool, tolerance: f64) -> impl Iterator<Item = Lost> {
    let [count, outs] = wanted.counted(tolerance);
    let pecks = count > 1 && (made.counts[0] < 2 || made.longest > LONGER * wanted.longest);
    let depths = [made.farthest, wanted.farthest];
    let retracts = match (made.counts[0], made.counts[1]) {
        _ if !comes_out || outs == 0 => None,
        (2.., 0) => Some(Lost::AllRetracts(wanted.farthest)),
        (_, 0) => Some(Lost::Retracts(depths)),
        _ => (made.farthest > LONGER * wanted.farthest).then_some(Lost::Retracts(depths)),
    };
    pecks.then_some(Lost::Pecks([made.longest, wanted.longest])).into_iter().chain(retracts)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The strokes of a hole whose feed begins at height 2. Each move is given by its target height, and by `true` for
    /// a feed move or `false` for a rapid.
    fn strokes(moves: &[(bool, f64)]) -> Strokes {
        let mut strokes = Strokes::over(2.0);
        for &(feeds, to) in moves {
            if feeds { strokes.cut(to, 0.001, 0.002) } else { strokes.comes_to(to) }
        }
        strokes
    }

    #[test]
    fn a_stroke_ends_where_the_tool_leaves_the_bottom() {
        let lifted = |up: f64| strokes(&[(true, -3.0), (false, -3.0 + up), (true, -8.0)]);
        assert_eq!((lifted(0.0).counts, lifted(0.0).longest), ([1, 0], 10.0));
        assert_eq!((lifted(0.001).counts, lifted(0.001).longest), ([2, 0], 5.0));
        assert_eq!(lifted(4.99).counts, [2, 0]);
        assert_eq!((lifted(5.0).counts, lifted(5.0).farthest), ([2, 1], 5.0));
        // the tool goes up at feed, as in a tap
        assert_eq!(strokes(&[(true, -3.0), (true, -2.0), (true, -8.0)]).counts, [2, 0]);
    }

    #[test]
    fn what_is_left_is_no_stroke() {
        assert_eq!(strokes(&[(true, -8.0), (false, 2.0), (true, -8.4)]).counted(0.002), [1, 0]);
        assert_eq!(strokes(&[(true, -8.0), (false, 2.0), (true, -8.6)]).counted(0.002), [2, 1]);
    }
}
