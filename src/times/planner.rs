//! Plans the speeds of moves by the corner rule of a control, and adds up their times.

use super::corner::{Corner, PathMode};
use super::curve::Curve;
use super::deviation::Deviation;
use super::linuxcnc::Linuxcnc;
use super::queue::{BlockTime, Queue, Spent};
use super::rates::{Rates, Way};

/// Plans the speeds of moves and adds up their times.
#[derive(Clone, Debug)]
pub struct Planner {
    rates: Rates,
    queue: Queue,
    rule: Rule,
}

/// The corner rule between two legs.
#[derive(Clone, Debug)]
enum Rule {
    Deviation(Deviation),
    Linuxcnc(Box<Linuxcnc>),
}

impl Planner {
    /// A planner whose tool is at rest.
    pub fn new(rates: Rates) -> Planner {
        let rule = match rates.corner {
            Corner::Deviation(deviation) => Rule::Deviation(Deviation::new(deviation)),
            Corner::Linuxcnc(mode) => Rule::Linuxcnc(Box::new(Linuxcnc::new(mode))),
        };
        Planner { queue: Queue::new(rates.ahead.max(1)), rates, rule }
    }

    /// Turns on the recording of the time of each block.
    pub fn keep_blocks(&mut self) {
        self.queue.blocks = Some(Vec::new());
    }

    /// Sets the line of the program to which the following moves belong.
    pub fn at_line(&mut self, line: u64) {
        if let Some(blocks) = &mut self.queue.blocks
            && blocks.last().is_none_or(|block| u64::from(block.line) != line)
        {
            blocks.push(BlockTime { line: line as u32, seconds: 0.0 });
        }
    }

    /// Adds to the current block a time, in seconds, that is not the time of a move.
    pub fn waits(&mut self, seconds: f64) {
        self.queue.adds(self.queue.row(), seconds);
    }

    /// The times of the blocks in the order in which they ran; empty if they were not recorded.
    pub fn take_blocks(&mut self) -> Vec<BlockTime> {
        self.queue.blocks.take().unwrap_or_default()
    }

    /// Adds a rapid.
    pub fn rapid(&mut self, way: &Way) {
        self.line(way, None);
    }

    /// Adds a straight cut. `feed` is in millimetres per second, or in degrees per second if only rotary axes move.
    pub fn cut(&mut self, way: &Way, feed: f64) {
        self.line(way, Some(feed));
    }

    /// Adds an arc at a feed in millimetres per second.
    pub fn arc(&mut self, curve: &Curve, feed: f64) {
        match &mut self.rule {
            Rule::Deviation(rule) => {
                for chord in curve.chords() {
                    rule.line(&chord, Some(feed), &self.rates, &mut self.queue);
                }
            }
            Rule::Linuxcnc(rule) => rule.arc(curve, feed, &self.rates, &mut self.queue),
        }
    }

    /// Sets the accuracy of the path; a control with only one mode ignores it.
    pub fn path_mode(&mut self, mode: PathMode) {
        if let Rule::Linuxcnc(rule) = &mut self.rule {
            rule.path_mode(mode, &self.rates, &mut self.queue);
        }
    }

    /// Stops the tool: the next move begins only after all moves before it have ended.
    pub fn stop(&mut self) {
        match &mut self.rule {
            Rule::Deviation(rule) => rule.stop(),
            Rule::Linuxcnc(rule) => rule.stop(&self.rates, &mut self.queue),
        }
        self.queue.stop();
    }

    /// Stops the tool, and returns the time since the last call.
    pub fn take(&mut self) -> Spent {
        self.stop();
        self.queue.take()
    }

    fn line(&mut self, way: &Way, feed: Option<f64>) {
        match &mut self.rule {
            Rule::Deviation(rule) => rule.line(way, feed, &self.rates, &mut self.queue),
            Rule::Linuxcnc(rule) => rule.line(way, feed, &self.rates, &mut self.queue),
        }
    }
}
