//! Plans the speeds of moves and counts their time, by the corner rules of a control.

use super::corner::{Corner, PathMode};
use super::curve::Curve;
use super::deviation::Deviation;
use super::linuxcnc::Linuxcnc;
use super::queue::{Queue, Spent};
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
