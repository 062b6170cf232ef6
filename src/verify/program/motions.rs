//! The rapids and cuts of the program, and the checks before each rapid or cut.

use super::{Doubt, Program};
use crate::nc::{Action, Cycle, Item, Position, ROTARY, Rotation, Turn};
use crate::toolpath::FeedMode;
use crate::verify::cut::{Cut, Rapid, Spin, What};
use crate::verify::expectation::taps_ahead;

impl Program<'_> {
    pub(super) fn rapid(&mut self, to: &Position, [machine, astray, placed, kept]: [u8; 4], line: u64) {
        let own = to;
        let to = self.scale.place(to);
        let unknown = self.scale.unknown(machine);
        self.beam_goes(own, to[..2] != self.at[..2], machine, line);
        let is_known = |unknown: u8| unknown == 0 || self.scale.flat && unknown == 0b100;
        let is_relengthened = std::mem::take(&mut self.is_relengthened);
        if is_known(unknown) && is_known(self.unknown) && to == self.at && !is_relengthened {
            return; // nothing moves
        }
        self.check_frame(unknown, line);
        // on a mill the height must be known, on a lathe X and Z
        let heights = if self.scale.lathe { 0b101 } else { 0b100 };
        let watched = if self.scale.wire.is_some() { 0b11 } else { heights };
        if self.scale.axes(astray) & watched != 0 {
            self.passage.astray.push((line, to));
            self.doubt.get_or_insert(Doubt::Astray(line));
        }
        if unknown & heights != heights {
            if (to[2] != self.at[2] || self.unknown & 0b100 != 0) && self.length_is_due() {
                self.without_length(line, "the tool goes down without its length offset");
            }
            self.units_are_due(line, "the program moves before its unit code");
            let length = self.state.length;
            if let Some(leg) = self.passage.leg()
                && leg.lengths.last() != Some(&length)
            {
                leg.lengths.push(length);
            }
        }
        if let Some(frames) = &self.frames {
            let moves = |axis: &usize| {
                unknown & 1 << axis == 0 && (self.at[*axis] != to[*axis] || self.unknown & 1 << axis != 0)
            };
            // the tool length has no effect on a turn of the part
            let goes = [0, 1, 2, 6, 7].iter().any(moves);
            if goes || [3, 4, 5].iter().any(moves) {
                let at = self.passage.rapids.len();
                self.passage.measured.rapid(at, frames, goes && unknown & heights == 0);
            }
        }
        (self.at, self.unknown, self.placed) = (to, unknown, placed);
        if placed != 0 {
            // the machine's zero is at the point of G28
            let point = self.simulator.reference_point().unwrap_or(0);
            let placed = placed & !ROTARY | self.scale.axes(placed) & ROTARY;
            let register = self.state.length.filter(|register| *register != 0.0 && self.simulator.may_keep_length());
            let length = register.map(|register| (self.simulator.state().length_axis(), register));
            self.passage.reaches_machine(placed, point, &to, length);
        }
        let kept = self.scale.axes(kept);
        self.passage.rapid(Rapid { to, unknown, kept, spin: Some(self.spin) });
    }

    /// Handles a straight cut. `lead`: feed per revolution, if the control synchronises the feed with the spindle.
    pub(super) fn feed(&mut self, to: &Position, (feed, lead): (f64, Option<f64>), home: u8, item: &Item) {
        let feed = match (lead, self.mode, self.state.speed) {
            (Some(lead), FeedMode::PerMinute, Some(speed)) if !self.state.css => lead * speed,
            (Some(lead), FeedMode::PerRev, _) => lead,
            _ => feed,
        };
        let own = to;
        let to = self.scale.place(to);
        let home = self.scale.axes(home);
        if to == self.at && (self.unknown == 0 || self.scale.flat && self.unknown == 0b100) && home == 0 {
            if !self.is_relengthened {
                return; // a move of no length cuts nothing
            }
            self.unknown |= self.scale.unknown(0b100);
        }
        if home == 0 {
            self.beam_cuts(own, item.line);
        }
        self.cuts_now(What::Line { to }, home, feed, lead, item);
    }

    pub(super) fn arc(&mut self, mut turn: Turn, item: &Item) {
        self.beam_cuts(&turn.to, item.line);
        turn.to = self.scale.end_of_arc(&turn.to);
        let factor = self.scale.factor();
        turn.center.iter_mut().for_each(|value| *value *= factor);
        self.cuts_now(What::Arc(turn), 0, turn.feed, None, item);
    }

    /// Begins a hole of a canned cycle.
    pub(super) fn hole(&mut self, cycle: Cycle) {
        self.cycle = true;
        if cycle.motions.taps() {
            self.before_tap.get_or_insert(self.state.rotation);
            self.state.taps(cycle);
        } else if self.state.into_tap.is_some() {
            self.state.into_tap = None;
        }
    }

    pub(super) fn cycle_ends(&mut self) {
        self.cycle = false;
        // no code of the program turns the spindle now
        if let Some(before) = self.before_tap.take()
            && before != self.state.rotation
        {
            self.state.rotation = Some(Rotation::Stop);
            self.spin = Spin::Turns(Rotation::Stop);
        }
        self.state.cycle_ends(taps_ahead(self.control));
    }

    /// The factor of the feed of a cut. If only rotary axes move, the feed is in degrees, and the same in all units.
    fn feed_factor(&self, what: &What) -> f64 {
        let is_linear = |axis: &usize| !(3..6).contains(axis);
        let turns = matches!(what, What::Line { to } if (0..8).filter(is_linear).all(|axis| to[axis] == self.at[axis]));
        if turns || self.mode == FeedMode::InverseTime { 1.0 } else { self.scale.factor() }
    }

    pub(super) fn cuts_now(&mut self, what: What, home: u8, feed: f64, lead: Option<f64>, item: &Item) {
        self.check_frame(0, item.line);
        self.is_relengthened = false;
        if self.length_is_due() {
            self.without_length(item.line, "the tool cuts without its length offset");
        }
        self.units_are_due(item.line, "the program cuts before its unit code");
        if home != 0 {
            self.doubt.get_or_insert(Doubt::Home(item.line));
        }
        let machine = match &item.action {
            Action::Feed { machine, .. } => *machine,
            Action::Arc(turn) => turn.machine,
            _ => 0,
        };
        self.placed = 0;
        let axes = if self.control.is_lathe() { 0b101 } else { !0 };
        let open = self.scale.unknown(machine) & axes;
        let mut state = self.state.clone();
        if let (true, Some(speed)) = (state.css, state.speed) {
            state.speed = Some(speed * self.scale.surface());
        }
        if lead.is_some() && state.rigid == Some(false) {
            state.rigid = Some(true);
        }
        let factor = self.feed_factor(&what);
        self.cut = Some(Cut {
            from: self.at,
            unknown: if self.scale.flat { self.unknown & !0b100 } else { self.unknown },
            home,
            open,
            what,
            feed: Some(feed * factor),
            mode: self.mode,
            lead: lead.map(|lead| lead * self.scale.factor()),
            state,
            by: [0; 2],
            by_cycle: item.by_cycle,
            line: item.line,
        });
    }
}
