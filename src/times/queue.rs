//! Plans the speeds over the known legs: each leg starts only as fast as the legs after it allow.

use std::collections::VecDeque;

use super::leg::Leg;

/// The time of moves, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spent {
    /// Seconds of cuts.
    pub cutting: f64,
    /// Seconds of rapids.
    pub rapid: f64,
}

/// The time of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockTime {
    /// Line of the block in the program, from 1.
    pub line: u32,
    /// The time of the block in seconds.
    pub seconds: f32,
}

/// Legs whose planned speeds may still rise.
///
/// The last leg is planned to end in a stop. A new leg may raise the speeds of the legs before it. The speeds are
/// recalculated backwards until a leg keeps its speed, then forwards as far as the accelerations allow. Legs that no
/// later leg can change are added to the time and removed. The first leg is also removed if the queue has more legs
/// than the control plans ahead.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    ahead: usize,
    /// The legs in their order. The entry speed of the first leg does not change any more.
    legs: VecDeque<Leg>,
    spent: Spent,
    /// The times of blocks, if they are recorded.
    pub blocks: Option<Vec<BlockTime>>,
}

impl Queue {
    pub fn new(ahead: usize) -> Queue {
        Queue { ahead, legs: VecDeque::new(), spent: Spent::default(), blocks: None }
    }

    /// The last leg; `None` if the tool is at rest.
    pub fn last(&self) -> Option<&Leg> {
        self.legs.back()
    }

    pub fn push(&mut self, leg: Leg) {
        self.legs.push_back(leg);
        let count = self.legs.len();
        // backwards: each leg as fast as the distance to the stop at the end allows
        let (mut exit, mut changed) = (0.0, count);
        for at in (1..count).rev() {
            let leg = &mut self.legs[at];
            let entry = leg.most_entry.min(leg.reached_from(exit));
            if entry == leg.entry && at + 1 < count {
                break;
            }
            (leg.entry, exit, changed) = (entry, entry, at);
        }
        // forwards: each leg as fast as the distance from the beginning allows; if this limits the speed, the speed is final
        let mut done = 0;
        for at in changed..count {
            let before = &self.legs[at - 1];
            let reached = before.reached_from(before.entry);
            let leg = &mut self.legs[at];
            if reached <= leg.entry {
                leg.entry = reached;
                done = at;
            } else if leg.entry == leg.most_entry {
                done = at;
            }
        }
        for _ in 0..done.max((count + 1).saturating_sub(self.ahead)) {
            self.count_first();
        }
    }

    /// Ends the last leg in a stop.
    pub fn stop(&mut self) {
        while let Some(leg) = self.legs.pop_front() {
            let exit = self.legs.front().map_or(0.0, |next| next.entry);
            self.count(&leg, exit);
        }
    }

    /// Returns the time since the last call.
    pub fn take(&mut self) -> Spent {
        std::mem::take(&mut self.spent)
    }

    /// Subtracts the time during which two moves overlap.
    pub fn overlap(&mut self, seconds: f64, is_cut: bool, row: usize) {
        *self.spent_on(is_cut) -= seconds;
        self.adds(row, -seconds);
    }

    /// The row of the current block in the times of blocks.
    pub fn row(&self) -> usize {
        self.blocks.as_ref().map_or(0, |blocks| blocks.len().saturating_sub(1))
    }

    /// Adds seconds to a row, if the times of blocks are recorded.
    pub fn adds(&mut self, row: usize, seconds: f64) {
        if let Some(block) = self.blocks.as_mut().and_then(|blocks| blocks.get_mut(row)) {
            block.seconds += seconds as f32;
        }
    }

    fn count_first(&mut self) {
        if self.legs.len() > 1
            && let Some(leg) = self.legs.pop_front()
        {
            self.count(&leg, self.legs[0].entry);
        }
    }

    fn count(&mut self, leg: &Leg, exit: f64) {
        let seconds = leg.seconds(exit);
        *self.spent_on(leg.is_cut) += seconds;
        self.adds(leg.row, seconds);
    }

    fn spent_on(&mut self, is_cut: bool) -> &mut f64 {
        if is_cut { &mut self.spent.cutting } else { &mut self.spent.rapid }
    }
}
