//! Plans the speeds of moves and counts their time, by the corner rules of a control.

use super::corner::{Corner, PathMode};
use super::curve::Curve;
use super::deviation::Deviation;
use super::linuxcnc::Linuxcnc;
use super::queue::{BlockTime, Queue, Spent};
use super::rates::{Rates, Way};

/// Plans the speeds of moves and counts their time.
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
    /// A planner with the tool at rest.
    pub fn new(rates: Rates) -> Planner {
        let rule = match rates.corner {
            Corner::Deviation(deviation) => Rule::Deviation(Deviation::new(deviation)),
            Corner::Linuxcnc(mode) => Rule::Linuxcnc(Box::new(Linuxcnc::new(mode))),
        };
        Planner { queue: Queue::new(rates.ahead.max(1)), rates, rule }
    }

    /// Keeps the times of blocks.
    pub fn keep_blocks(&mut self) {
        self.queue.blocks = Some(Vec::new());
    }

    /// The next moves are those of the block in this line of the program.
    pub fn at_line(&mut self, line: u64) {
        if let Some(blocks) = &mut self.queue.blocks
            && blocks.last().is_none_or(|block| u64::from(block.line) != line)
        {
            blocks.push(BlockTime { line: line as u32, seconds: 0.0 });
        }
    }

    /// Time of the block besides its moves.
    pub fn waits(&mut self, seconds: f64) {
        self.queue.adds(self.queue.row(), seconds);
    }

    /// The times of blocks in the order in which they ran; empty if they were not kept.
    pub fn take_blocks(&mut self) -> Vec<BlockTime> {
        self.queue.blocks.take().unwrap_or_default()
    }

    /// A rapid.
    pub fn rapid(&mut self, way: &Way) {
        self.line(way, None);
    }

    /// A straight cut at a feed in millimetres per second, or degrees if only rotary axes move.
    pub fn cut(&mut self, way: &Way, feed: f64) {
        self.line(way, Some(feed));
    }

    /// An arc at a feed in millimetres per second.
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

    /// The tool stops: the next move waits for all moves before it.
    pub fn stop(&mut self) {
        match &mut self.rule {
            Rule::Deviation(rule) => rule.stop(),
            Rule::Linuxcnc(rule) => rule.stop(&self.rates, &mut self.queue),
        }
        self.queue.stop();
    }

    /// Stops, and returns the time since the last call.
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
