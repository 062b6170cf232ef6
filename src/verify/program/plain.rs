//! The most frequent cut of a program: straight, directly after another cut and with the same state. This kind of cut
//! is compared without creating a [`Cut`](super::Cut), because most cuts of long programs are of this kind.

use super::Program;
use crate::nc::{Action, Item, RunError};
use crate::toolpath::FeedMode;
use crate::verify::cut::{Place, Rapid, Shared};

/// A cut of the most frequent kind.
#[derive(Clone, Copy)]
pub(in super::super) struct Plain {
    /// The end of the cut.
    pub to: Place,
    /// The feed in the job's units.
    pub feed: f64,
}

impl Program<'_> {
    /// The position and the state at which a cut of the most frequent kind would begin. `None`: the next cut is of
    /// another kind.
    #[inline]
    pub fn before_plain(&self) -> Option<(&Place, FeedMode, &Shared)> {
        let is_usual = self.next == self.items.len()
            && (self.unknown == 0 || self.scale.flat && self.unknown == 0b100)
            && self.is_usual();
        is_usual.then_some((&self.at, self.mode, &self.state))
    }

    /// Whether the program is directly after a cut, and the next cut needs none of the checks that only few programs
    /// need.
    #[inline]
    pub(super) fn is_usual(&self) -> bool {
        self.cut.is_none()
            && !(self.over || self.ended)
            && self.doubt.is_none()
            && self.failed.is_none()
            && self.scale.wire.is_none()
            && self.passage.is_plain()
            && !self.passage.new_tool
            && self.beam.is_none()
            && !self.due.has_units()
            && !self.length_is_due()
            && (!self.state.css || self.scale.surface() == 1.0)
    }

    /// Runs the next block after [`Program::before_plain`]. If the block makes a cut of the most frequent kind, returns
    /// the cut; call [`Program::take_plain`] after it. If not, call [`Program::run_to_cut`] to reach the next cut.
    #[inline]
    pub fn next_plain(&mut self) -> Option<Plain> {
        if let Err(error) = self.run_block() {
            self.failed = Some(error);
            return None;
        }
        let [Item { by_cycle: false, action: Action::Feed { to, feed, lead: None, home: 0, .. }, .. }] =
            &self.items[..]
        else {
            return None;
        };
        let to = self.scale.place(to);
        if to == self.at || self.simulator.state().frame_unknown() != 0 {
            return None;
        }
        let factor = if self.mode == FeedMode::InverseTime { 1.0 } else { self.scale.factor() };
        Some(Plain { to, feed: feed * factor })
    }

    /// Ends the cut of [`Program::next_plain`].
    #[inline]
    pub fn take_plain(&mut self, cut: &Plain) {
        self.next = self.items.len();
        self.placed = 0;
        self.ends_cut(cut.to);
    }

    /// Runs the next block. The actions of the block are processed later.
    #[inline]
    pub(super) fn run_block(&mut self) -> Result<(), RunError> {
        self.items.clear();
        self.next = 0;
        let line = self.simulator.line();
        if let Some(text) = self.simulator.text_to_keep() {
            self.recent.keep(line, text);
        }
        self.over = !self.simulator.step(&mut self.items)?;
        Ok(())
    }

    /// Ends a cut and begins the next passage.
    #[inline]
    pub(super) fn ends_cut(&mut self, at: Place) {
        self.at = at;
        // the end of the cut may give a height that was unknown before
        self.unknown = self.scale.unknown(self.simulator.state().at_machine());
        self.passage.begin(Rapid { to: at, unknown: self.unknown, kept: 0, spin: Some(self.spin) });
        self.cuts = true;
    }
}
