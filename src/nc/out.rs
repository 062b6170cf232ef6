//! The output of actions, and the ways in which a program continues after a block.

use super::action::{Action, Item};
use super::profiled::Profiled;

/// Maximum number of actions of one call. If a block makes more actions, the next call makes the rest.
const AT_ONCE: usize = 4096;

/// How a program continues after a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// The program continues with the next block.
    On,
    /// The program has ended.
    End,
    /// The program calls a subprogram: the number of the subprogram, and the number of runs.
    Call(f64, u32),
    /// The program returns from a subprogram.
    Return,
    /// The block is not finished: continue with `State::run_on`.
    Rest,
    /// The block contains a cycle that follows a profile of the program.
    Profile(Profiled),
}

/// The output to which a block adds its actions.
pub struct Out<'a> {
    /// The list of actions. The list also contains actions of earlier blocks.
    pub items: &'a mut Vec<Item>,
    /// Number of actions in the list before the block.
    start: usize,
    /// Line of the block.
    pub line: u64,
    /// Whether the next actions are part of a canned cycle.
    pub by_cycle: bool,
}

impl<'a> Out<'a> {
    /// An output for a line. The actions of the line are appended to `items`.
    pub fn new(items: &'a mut Vec<Item>, line: u64) -> Out<'a> {
        Out { start: items.len(), items, line, by_cycle: false }
    }

    /// Whether the output has so many actions that the caller should read them first.
    #[inline]
    pub fn is_full(&self) -> bool {
        self.items.len() - self.start >= AT_ONCE
    }

    /// Removes all actions of the block.
    pub fn take_back(&mut self) {
        self.items.truncate(self.start);
    }

    /// Adds an action.
    #[inline]
    pub fn push(&mut self, action: Action) {
        self.items.push(Item { line: self.line, by_cycle: self.by_cycle, action });
    }
}
