//! Checks the feeds of cuts against the fastest feeds of the axes.

use super::check::Check;
use crate::diag::Code;
use crate::machine::LETTERS;
use crate::nc::{Position, Simulator, Turn, axes_of, sweep};
use crate::times::Curve;
use crate::toolpath::Direction;

impl Check<'_> {
    /// Checks the feed of a straight cut. If the feed is per revolution, it depends on the spindle speed. Returns the
    /// feed in millimetres per minute, or in degrees per minute if only rotary axes move.
    pub(super) fn straight_feed(
        &mut self,
        from: &Position,
        to: &Position,
        (feed, lead): (f64, Option<f64>),
        run: &Simulator<'_>,
        line: (u64, &[u8]),
    ) -> f64 {
        let way: Position = std::array::from_fn(|axis| to[axis] - from[axis]);
        let size = |way: &[f64]| way.iter().map(|part| part * part).sum::<f64>().sqrt();
        let (scale, length) = (run.state().units().in_mm(), size(&way[..3]));
        self.turn_feeds(&way, length, (feed, lead), line);
        if length == 0.0 {
            return self.pace.per_minute(feed, lead, size(&way), 1.0, from[0].abs());
        }
        let radius = (from[0] + to[0]).abs() / 2.0 * scale;
        if lead.is_none() {
            let path = self.path_of_feed(length, size(&way[3..]));
            let along = self.pace.per_minute(feed, lead, path * scale, scale, radius);
            for (axis, part) in way[..3].iter().enumerate() {
                self.feeds(axis, along * part.abs() / path, line);
            }
        }
        self.pace.per_minute(feed, lead, length * scale, scale, radius)
    }

    /// The length of the path to which F applies, in a cut that turns the part by an angle in degrees. On LinuxCNC, F
    /// is the feed along X, Y and Z. A Fanuc counts a degree as a millimetre or an inch. Other controls may do so, too,
    /// and then all axes are slower.
    fn path_of_feed(&self, length: f64, turned: f64) -> f64 {
        if self.control.is_linuxcnc() && length > 0.0 { length } else { length.hypot(turned) }
    }

    /// Checks the feeds of the rotary axes in a cut of this length in the program's units.
    fn turn_feeds(&mut self, way: &Position, length: f64, (feed, lead): (f64, Option<f64>), line: (u64, &[u8])) {
        let turned = way[3..].iter().map(|part| part * part).sum::<f64>().sqrt();
        if turned == 0.0 || lead.is_some() {
            return;
        }
        let path = self.path_of_feed(length, turned);
        let feed = self.pace.per_minute(feed, None, path, 1.0, 0.0);
        for (axis, part) in way.iter().enumerate().skip(3) {
            self.feeds(axis, feed * part.abs() / path, line);
        }
    }

    /// Returns the arc for the clock, and its feed in millimetres per minute. On a full arc each axis reaches the whole
    /// feed at some point; on a short arc the fastest feed of an axis may be less.
    pub(super) fn arc_feed(
        &mut self,
        from: &Position,
        turn: &Turn,
        run: &Simulator<'_>,
        line: (u64, &[u8]),
    ) -> (Curve, f64) {
        let scale = run.state().units().in_mm();
        let [first, second, _] = axes_of(turn.plane);
        let begin = [first, second].map(|axis| (from[axis] - turn.center[axis]) * scale);
        let sign = if turn.direction == Direction::Ccw { 1.0 } else { -1.0 };
        let curve = Curve { plane: [first, second], from: begin, sweep: sign * sweep(from, turn), rise: [0.0; 6] };
        let radius = (from[0] + turn.to[0]).abs() / 2.0 * scale;
        let way: Position = std::array::from_fn(|axis| turn.to[axis] - from[axis]);
        self.turn_feeds(&way, curve.length() / scale, (turn.feed, None), line);
        let feed = self.pace.per_minute(turn.feed, None, curve.length(), scale, radius);
        if !self.pace.is_inverse() {
            for axis in [first, second] {
                self.feeds(axis, feed, line);
            }
        }
        (curve, feed)
    }

    fn feeds(&mut self, axis: usize, feed: f64, line: (u64, &[u8])) {
        let Some(most) = self.machine.axes[axis].as_ref().and_then(|axis| axis.feed) else { return };
        if feed > most * (1.0 + 1e-9) {
            let [shown, most] = [feed, most].map(|feed| match axis {
                0..3 => self.machine.shown(feed),
                _ => self.machine.at(axis, feed),
            });
            let unit = if axis < 3 { self.machine.units.name() } else { "degrees" };
            let message = format!("{} would feed at {shown} {unit}/min, but its maximum is {most}", LETTERS[axis]);
            let help = "the control feeds slower, or stops with an alarm: write a feed up to the maximum";
            self.found(Code::PM010, &format!("feed {axis}"), message, help, line);
        }
    }
}
