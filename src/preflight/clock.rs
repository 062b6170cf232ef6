//! Computes the time of a program on its machine, with the accelerations of the axes.

use super::place::{At, Base};
use crate::control::Code;
use crate::machine::Machine;
use crate::nc::Rotation;
use crate::times::{BlockTime, Curve, PathMode, Planner, Way};

/// The times of a program, in seconds. Program stops are not counted, because the operator ends them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Times {
    /// Time of cuts.
    pub cutting: f64,
    /// Time of rapids.
    pub rapid: f64,
    /// Time of dwells.
    pub dwells: f64,
    /// Time of tool changes, chip to chip, as given in the machine's file. The time of a tool change includes the
    /// spindle start after the change.
    pub changes: f64,
    /// Time of spindle speed changes. A control does not wait while the spindle stops.
    pub spindle: f64,
    /// Number of moves from or to an unknown position. The times do not include the travel of these moves along the
    /// unknown axes.
    pub unplaced: u64,
    /// Number of cuts whose time is unknown, because the feed depends on a spindle speed that is not set.
    pub timeless: u64,
    /// Time of each tool, in the order of first use. The tool is `None` before the first tool change.
    pub tools: Vec<(Option<u32>, f64)>,
}

impl Times {
    /// The total, in seconds.
    pub fn whole(&self) -> f64 {
        self.cutting + self.rapid + self.dwells + self.changes + self.spindle
    }

    /// A sentence with the total, its parts, and everything that is not counted.
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

    /// The times as JSON, in seconds.
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
    /// The total time up to the change to the current tool.
    before: f64,
    tool: Option<u32>,
    /// Duration of a tool change, in seconds.
    change: f64,
    /// Time in seconds in which the spindle speed changes by one revolution per minute.
    spin_up: f64,
    /// Spindle speed in revolutions per minute; negative counterclockwise.
    turning: f64,
    /// Whether a tool was just changed. The time of a tool change includes the next spindle start.
    is_fresh: bool,
}

impl Clock {
    /// Creates a clock for a machine.
    ///
    /// # Errors
    /// The machine's file lacks values that the clock needs. The text names the missing values.
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

    /// Turns on the recording of the time of each block.
    pub fn keep_blocks(&mut self) {
        self.planner.keep_blocks();
    }

    /// Sets the line of the program to which the following moves belong.
    pub fn at_line(&mut self, line: u64) {
        self.planner.at_line(line);
    }

    /// Adds a rapid between two positions.
    pub fn rapid(&mut self, before: &[At; 6], after: &[At; 6]) {
        let way = self.way(before, after);
        self.planner.rapid(&way);
    }

    /// Adds a straight cut. `feed` is in millimetres per minute, or in degrees per minute if only rotary axes move.
    pub fn cut(&mut self, before: &[At; 6], after: &[At; 6], feed: f64) {
        let way = self.way(before, after);
        if feed.is_finite() && feed > 0.0 {
            self.planner.cut(&way, feed / 60.0);
        } else {
            self.times.timeless += 1;
        }
    }

    /// Adds an arc at a feed in millimetres per minute. The travel outside the plane of the arc is calculated from the
    /// positions `before` and `after` the arc.
    pub fn arc(&mut self, mut curve: Curve, before: &[At; 6], after: &[At; 6], feed: f64) {
        curve.rise = self.way(before, after);
        curve.plane.iter().for_each(|&axis| curve.rise[axis] = 0.0);
        if feed.is_finite() && feed > 0.0 {
            self.planner.arc(&curve, feed / 60.0);
        } else {
            self.times.timeless += 1;
        }
    }

    /// Adds a dwell.
    pub fn dwell(&mut self, seconds: f64) {
        self.planner.stop();
        self.times.dwells += seconds;
        self.planner.waits(seconds);
    }

    /// Stops the axes, for example at a program stop, a coolant command or an exact stop.
    pub fn stop(&mut self) {
        self.planner.stop();
    }

    /// Sets the accuracy of the path: G61, G61.1, or G64 with its P in millimetres.
    pub fn follows(&mut self, code: Code, tolerance: Option<f64>) {
        let mode = match code.tenths {
            610 => PathMode::Exact,
            611 => PathMode::Stop,
            640 => PathMode::Blend(tolerance),
            _ => return,
        };
        self.planner.path_mode(mode);
    }

    /// Sets the direction and the speed of the spindle, in revolutions per minute.
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

    /// Changes the tool.
    pub fn change(&mut self, tool: Option<u32>) {
        self.end_tool();
        self.tool = tool;
        self.times.changes += self.change;
        self.planner.waits(self.change);
        (self.turning, self.is_fresh) = (0.0, self.change > 0.0);
    }

    /// Ends the clock. Returns the times, and the times of the blocks if they were recorded.
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

    /// The travel of each axis; 0 for an axis whose travel is unknown.
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
