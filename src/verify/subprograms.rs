//! Subprograms of the job. The items of each subprogram are kept when it is defined, and are run again at each call.

use super::intent::{Done, unproven};
use super::tables::Unmodelled;
use crate::toolpath::{Event, Kept, Place};

/// The largest number of items that are kept for all subprograms.
const MOST: usize = 1 << 18;

/// The subprograms defined so far.
#[derive(Debug, Default)]
pub(super) struct Subprograms {
    pub(super) defined: Vec<Subprogram>,
    open: bool,
    held: usize,
    pub(super) done: u64,
    pub(super) depth: u32,
}

#[derive(Debug)]
pub(super) struct Subprogram {
    pub(super) number: f64,
    pub(super) items: Vec<(Kept, Place)>,
}

impl Subprograms {
    /// The number of subprograms.
    pub fn count(&self) -> usize {
        self.defined.len()
    }

    /// Keeps an item if it belongs to a subprogram. Returns `false` if the item is outside of subprograms.
    pub fn hold(&mut self, event: &Event<'_>, place: Place) -> Done<bool> {
        match event {
            Event::SubStart(number) => {
                self.defined.push(Subprogram { number: *number, items: Vec::new() });
                self.open = true;
            }
            Event::SubEnd => self.open = false,
            event if self.open => {
                self.held += 1;
                if self.held > MOST {
                    return unproven(Unmodelled::LongSubprograms);
                }
                if let Some(last) = self.defined.last_mut() {
                    last.items.push((Kept::from(event), place));
                }
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}
