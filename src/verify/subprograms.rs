//! Subprograms of the job: held where they are defined, and done again at each call.

use super::intent::{Done, unproven};
use super::owned_event::Kept;
use super::tables::Unmodelled;
use crate::toolpath::{Event, Place};

/// Items of subprograms that are held.
const MOST: usize = 1 << 18;

/// Those defined so far.
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
    /// How many there are.
    pub fn count(&self) -> usize {
        self.defined.len()
    }

    /// Holds an item of the one that is being defined; `false`: none is.
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
