//! The time of a program on its machine, with the accelerations of its axes.

use super::place::{At, Base};
use crate::control::Code;
use crate::machine::Machine;
use crate::nc::Rotation;
use crate::times::{BlockTime, Curve, PathMode, Planner, Way};

/// The time of a program, in seconds. Stops are not counted, because the operator ends them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Times {
    /// Cuts.
    pub cutting: f64,
    /// Rapids.
    pub rapid: f64,
    /// Dwells.
    pub dwells: f64,
    /// Tool changes, from chip to chip as in the machine's file; this includes the next spindle start.
    pub changes: f64,
    /// Spindle speed changes; a control does not wait while the spindle stops.
    pub spindle: f64,
    /// Number of moves from or to an unknown position: their travel along the unknown axes is not counted.
    pub unplaced: u64,
    /// Number of cuts without a time: their feed depends on a spindle without a speed.
    pub timeless: u64,
    /// Each tool's own time, in the order of first use; `None` before the first change.
    pub tools: Vec<(Option<u32>, f64)>,
}

impl Times {
    /// The total, in seconds.
    pub fn whole(&self) -> f64 {
        self.cutting + self.rapid + self.dwells + self.changes + self.spindle
    }

    /// The total and its parts in a sentence, with everything that is not counted.
    pub fn sentence(&self) -> String {
        let time = |seconds: f64| crate::nc::clock(seconds / 60.0);
        let mut text = format!(
            "{}: cutting {}, rapids {}, dwells {}, tool changes {}, spindle {}",
            time(self.whole()),
            time(self.cutting),
            time(self.rapid),
            time(self.dwells),
            time(self.changes),
            time(self.spindle)
        );
        let unplaced = (self.unplaced, "from or to an unknown position");
        let timeless = (self.timeless, "with a feed per revolution, but without a spindle speed");
        for (count, what) in [unplaced, timeless].into_iter().filter(|(count, _)| *count > 0) {
            let moves = if count == 1 { "move" } else { "moves" };
            text += &format!("; not counted in full: {count} {moves} {what}");
        }
        text
    }

    /// The same times as JSON for other programs, in seconds.
    pub fn json(&self) -> serde_json::Value {
        let tools: Vec<_> =
            self.tools.iter().map(|(tool, seconds)| serde_json::json!({ "tool": tool, "seconds": seconds })).collect();
        serde_json::json!({
            "whole": self.whole(), "cutting": self.cutting, "rapids": self.rapid, "dwells": self.dwells,
            "changes": self.changes, "spindle": self.spindle, "tools": tools,
            "not_counted": { "unknown_position": self.unplaced, "unknown_feed": self.timeless },
        })
    }
}

/// Counts the time of a program.
#[derive(Debug)]
pub(super) struct Clock {
    planner: Planner,
    times: Times,
    /// The total time before the tool in use.
    before: f64,
    tool: Option<u32>,
    /// Seconds of a tool change.
    change: f64,
    /// Seconds per revolution per minute.
    spin_up: f64,
    /// Revolutions per minute; negative in the other direction.
    turning: f64,
    /// The time of the tool change includes the next spindle start.
    is_fresh: bool,
}

impl Clock {
    /// # Errors
    /// The missing values of the machine's file, in words.
    pub fn of(machine: &Machine) -> Result<Clock, String> {
        let fastest = machine.speeds.map_or(f64::INFINITY, |[_, fastest]| fastest);
        Ok(Clock {
            planner: Planner::new(machine.rates()?),
            times: Times::default(),
            before: 0.0,
            tool: None,
            change: machine.change.unwrap_or(0.0),
            spin_up: machine.spin_up.unwrap_or(0.0) / fastest,
            turning: 0.0,
            is_fresh: false,
        })
    }

    /// Keeps the times of blocks.
    pub fn keep_blocks(&mut self) {
        self.planner.keep_blocks();
    }

    /// What follows belongs to the block in this line of the program.
    pub fn at_line(&mut self, line: u64) {
        self.planner.at_line(line);
    }

    /// A rapid between two positions.
    pub fn rapid(&mut self, before: &[At; 6], after: &[At; 6]) {
        let way = self.way(before, after);
        self.planner.rapid(&way);
    }

    /// A straight cut at a feed in millimetres per minute, or degrees if only rotary axes move.
    pub fn cut(&mut self, before: &[At; 6], after: &[At; 6], feed: f64) {
        let way = self.way(before, after);
        if feed.is_finite() && feed > 0.0 {
            self.planner.cut(&way, feed / 60.0);
        } else {
            self.times.timeless += 1;
        }
    }

    /// An arc at a feed in millimetres per minute; motion outside its plane is in the positions.
    pub fn arc(&mut self, mut curve: Curve, before: &[At; 6], after: &[At; 6], feed: f64) {
        curve.rise = self.way(before, after);
        curve.plane.iter().for_each(|&axis| curve.rise[axis] = 0.0);
        if feed.is_finite() && feed > 0.0 {
            self.planner.arc(&curve, feed / 60.0);
        } else {
            self.times.timeless += 1;
        }
    }

    /// A dwell.
    pub fn dwell(&mut self, seconds: f64) {
        self.planner.stop();
        self.times.dwells += seconds;
        self.planner.waits(seconds);
    }

    /// The axes stop: for a program stop, a coolant command or an exact stop.
    pub fn stop(&mut self) {
        self.planner.stop();
    }

    /// G61, G61.1 or G64 with its P in millimetres: the accuracy of the path.
    pub fn follows(&mut self, code: Code, tolerance: Option<f64>) {
        let mode = match code.tenths {
            610 => PathMode::Exact,
            611 => PathMode::Stop,
            640 => PathMode::Blend(tolerance),
            _ => return,
        };
        self.planner.path_mode(mode);
    }

    /// The spindle turns at a speed in revolutions per minute.
    pub fn spindle(&mut self, rotation: Rotation, speed: f64) {
        self.planner.stop();
        let turning = match rotation {
            Rotation::Stop => 0.0,
            Rotation::Cw => speed,
            Rotation::Ccw => -speed,
        };
        if turning != 0.0 && !std::mem::take(&mut self.is_fresh) {
            let seconds = (turning - self.turning).abs() * self.spin_up;
            self.times.spindle += seconds;
            self.planner.waits(seconds);
        }
        self.turning = turning;
    }

    /// A tool is changed.
    pub fn change(&mut self, tool: Option<u32>) {
        self.end_tool();
        self.tool = tool;
        self.times.changes += self.change;
        self.planner.waits(self.change);
        (self.turning, self.is_fresh) = (0.0, self.change > 0.0);
    }

    /// The times, and those of the blocks, if they were kept.
    pub fn finish(mut self) -> (Times, Vec<BlockTime>) {
        self.end_tool();
        (self.times, self.planner.take_blocks())
    }

    fn end_tool(&mut self) {
        let spent = self.planner.take();
        self.times.cutting += spent.cutting;
        self.times.rapid += spent.rapid;
        let whole = self.times.whole();
        let own = whole - std::mem::replace(&mut self.before, whole);
        match self.times.tools.iter_mut().find(|(tool, _)| *tool == self.tool) {
            Some((_, seconds)) => *seconds += own,
            None if own > 0.0 => self.times.tools.push((self.tool, own)),
            None => {}
        }
    }

    /// The travel of each axis, if it is known.
    fn way(&mut self, before: &[At; 6], after: &[At; 6]) -> Way {
        let mut is_whole = true;
        let way = std::array::from_fn(|axis| {
            let (from, to) = (before[axis], after[axis]);
            let is_known = match (from.base, to.base) {
                (Base::Unknown, Base::Unknown) => return 0.0,
                (Base::Unknown, _) | (_, Base::Unknown) => false,
                (Base::Machine, Base::Machine) => true,
                (Base::Work(a), Base::Work(b)) => a == b || ![a, b].iter().any(|needs| needs.is_open()),
                (Base::Work(needs), Base::Machine) | (Base::Machine, Base::Work(needs)) => !needs.is_open(),
            };
            is_whole &= is_known;
            if is_known { to.value - from.value } else { 0.0 }
        });
        self.times.unplaced += u64::from(!is_whole);
        way
    }
}
