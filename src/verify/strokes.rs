//! Strokes in a hole: what pecks come to, counted alike for job and program.

use super::tables::LEFT;

/// What the feeds in a hole come to so far. A stroke ends where the tool leaves the bottom, not where a block does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Strokes {
    /// Where the feed begins.
    plane: f64,
    /// The deepest height so far.
    pub deepest: f64,
    /// The greatest height since then.
    highest: f64,
    /// Where the last stroke began to cut.
    begun: f64,
    /// How deep the hole was when the tool was out of it last.
    out: f64,
    /// Strokes, and how many of them came after the tool was out of the hole.
    pub counts: [u64; 2],
    /// The same without the last stroke.
    earlier: [u64; 2],
    /// The longest stroke.
    pub longest: f64,
    /// The most that was cut without coming out of the hole.
    pub farthest: f64,
}

impl Strokes {
    /// None yet, in a hole whose feed begins at this height.
    pub fn over(plane: f64) -> Strokes {
        Strokes { plane, deepest: plane, highest: plane, begun: plane, out: plane, ..Strokes::default() }
    }

    /// The tool comes to a height.
    pub fn comes_to(&mut self, height: f64) {
        self.highest = self.highest.max(height);
    }

    /// A feed goes to a height. `increment`: one digit of the form along the hole, in the job's units.
    pub fn cut(&mut self, to: f64, increment: f64, tolerance: f64) {
        self.comes_to(to);
        if to >= self.deepest {
            return;
        }
        let [count, outs] = self.counts;
        // a digit of the form, whatever binary numbers make of it
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

    /// The counts without a last stroke that is only what was left.
    pub fn counted(&self, tolerance: f64) -> [u64; 2] {
        let last = self.begun - self.deepest;
        if last > (LEFT * self.longest).max(2.0 * tolerance) { self.counts } else { self.earlier }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strokes of a hole from 2 down: heights to which the tool goes, `true` where it feeds.
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
        // up at feed, as a tap goes
        assert_eq!(strokes(&[(true, -3.0), (true, -2.0), (true, -8.0)]).counts, [2, 0]);
    }

    #[test]
    fn what_is_left_is_no_stroke() {
        assert_eq!(strokes(&[(true, -8.0), (false, 2.0), (true, -8.4)]).counted(0.002), [1, 0]);
        assert_eq!(strokes(&[(true, -8.0), (false, 2.0), (true, -8.6)]).counted(0.002), [2, 1]);
    }
}
