//! The output of actions, and the continuation of the program after a block.

use super::action::{Action, Item};
use super::profiled::Profiled;

/// The number of actions of one call. The rest of a longer block waits for the next call.
const AT_ONCE: usize = 4096;

/// How a program continues after a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// The program goes on with the next block.
    On,
    /// The program is over.
    End,
    /// The program calls a subprogram, this many times.
    Call(f64, u32),
    /// The program returns from a subprogram.
    Return,
    /// The block is not finished: continue with `State::run_on`.
    Rest,
    /// A cycle that follows a profile of the program.
    Profile(Profiled),
}

/// The output for the actions of a block.
pub struct Out<'a> {
    /// All actions so far, including those of earlier blocks.
    pub items: &'a mut Vec<Item>,
    /// Number of actions before the block.
    start: usize,
    /// Line of the block.
    pub line: u64,
    /// Whether the next actions are made by a canned cycle.
    pub by_cycle: bool,
}

impl<'a> Out<'a> {
    /// An output for a line. Its actions are appended to `items`.
    pub fn new(items: &'a mut Vec<Item>, line: u64) -> Out<'a> {
        Out { start: items.len(), items, line, by_cycle: false }
    }

    /// Whether there are enough actions to be read.
    #[inline]
    pub fn is_full(&self) -> bool {
        self.items.len() - self.start >= AT_ONCE
    }

    /// Removes the actions of the block.
    pub fn take_back(&mut self) {
        self.items.truncate(self.start);
    }

    /// Adds an action.
    #[inline]
    pub fn push(&mut self, action: Action) {
        self.items.push(Item { line: self.line, by_cycle: self.by_cycle, action });
    }
}
