//! Where actions go, and where a program goes after a block.

use super::action::{Action, Item};
use super::profiled::Profiled;

/// Actions after which the rest of a block waits for the next call.
const AT_ONCE: usize = 4096;

/// Where a program goes after a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// The program goes on with the next block.
    On,
    /// The program is over.
    End,
    /// The program calls a subprogram, this many times.
    Call(f64, u32),
    /// Back from a subprogram.
    Return,
    /// The block is not done: `State::run_on`.
    Rest,
    /// A cycle follows a profile of the program.
    Profile(Profiled),
}

/// The actions of a block.
pub struct Out<'a> {
    /// All actions so far, of other blocks, too.
    pub items: &'a mut Vec<Item>,
    /// How many actions there were before the block.
    start: usize,
    /// Line of the block.
    pub line: u64,
    /// A canned cycle makes what follows.
    pub by_cycle: bool,
}

impl<'a> Out<'a> {
    /// Actions of a line, put after those that are there.
    pub fn new(items: &'a mut Vec<Item>, line: u64) -> Out<'a> {
        Out { start: items.len(), items, line, by_cycle: false }
    }

    /// Is there enough to be read?
    #[inline]
    pub fn is_full(&self) -> bool {
        self.items.len() - self.start >= AT_ONCE
    }

    /// Takes the actions of the block back.
    pub fn take_back(&mut self) {
        self.items.truncate(self.start);
    }

    /// Adds an action.
    #[inline]
    pub fn push(&mut self, action: Action) {
        self.items.push(Item { line: self.line, by_cycle: self.by_cycle, action });
    }
}
