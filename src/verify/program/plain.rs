//! The most frequent cut of a program: straight, directly after another cut and with the same state. This kind of cut
//! is compared without creating a [`Cut`](super::Cut), because most cuts of long programs are of this kind.

use super::Program;
use crate::nc::{Action, Item, NextCut, Position, RunError};
use crate::toolpath::FeedMode;
use crate::verify::cut::{Place, Rapid, Shared};

/// A cut of the most frequent kind.
#[derive(Clone, Copy)]
pub(in super::super) struct Plain {
    /// The end of the cut.
    pub to: Place,
    /// The feed in the job's units.
    pub feed: f64,
    /// The block of the cut, if it is not run yet.
    ahead: Option<NextCut>,
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

    /// The next cut after [`Program::before_plain`], if it is of the most frequent kind: then call
    /// [`Program::take_plain`]. If not, or if the cut differs from the job's, call [`Program::run_to_cut`].
    #[inline]
    pub fn next_plain(&mut self) -> Option<Plain> {
        let ahead = self.simulator.next_cut();
        let (to, feed) = match &ahead {
            Some(NextCut { cut, .. }) => (cut.to, cut.feed),
            None => self.run_plain()?,
        };
        let to = self.scale.place(&to);
        if to == self.at || self.simulator.state().frame_unknown() != 0 {
            return None;
        }
        let factor = if self.mode == FeedMode::InverseTime { 1.0 } else { self.scale.factor() };
        Some(Plain { to, feed: feed * factor, ahead })
    }

    /// Runs the next block. If it makes one cut, returns the end and the feed of the cut.
    fn run_plain(&mut self) -> Option<(Position, f64)> {
        if let Err(error) = self.run_block() {
            self.failed = Some(error);
            return None;
        }
        match &self.items[..] {
            [Item { by_cycle: false, action: Action::Feed { to, feed, lead: None, home: 0, .. }, .. }] => {
                Some((*to, *feed))
            }
            _ => None,
        }
    }

    /// Ends the cut of [`Program::next_plain`].
    #[inline]
    pub fn take_plain(&mut self, cut: &Plain) {
        if let Some(ahead) = &cut.ahead {
            self.keep_line();
            self.simulator.make_cut(ahead);
        }
        self.next = self.items.len();
        self.placed = 0;
        self.ends_cut(cut.to);
    }

    /// Runs the next block. The actions of the block are processed later.
    #[inline]
    pub(super) fn run_block(&mut self) -> Result<(), RunError> {
        self.items.clear();
        self.next = 0;
        self.keep_line();
        self.over = !self.simulator.step(&mut self.items)?;
        Ok(())
    }

    /// Keeps the text of the line that was run last.
    #[inline]
    pub(super) fn keep_line(&mut self) {
        let line = self.simulator.line();
        if let Some(text) = self.simulator.text_to_keep() {
            self.recent.keep(line, text);
        }
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
