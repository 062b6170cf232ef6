//! Converts the holes of a program to cycles of a job. The holes of one pattern become one cycle, even if rapids are between them.

use super::cycles::{hole_of, is_same, spec_of};
use super::fault::{Done, unsaid};
use super::moves::Moves;
use super::pattern::Pattern;
use super::reader::Reader;
use crate::control::Motions;
use crate::nc::action::{Action, Drilling, Heights, Position, Rotation};
use crate::toolpath::{Event, First, Plane};

impl Reader<'_> {
    /// Stores a rapid if it may be a move to the next hole of the cycle. Returns whether the rapid was stored.
    pub(super) fn leads_on(&mut self, to: &Position, machine: u8) -> bool {
        if self.operation || self.turning.is_some() {
            return false;
        }
        let (place, used) = (self.place, self.used());
        let Some(pattern) = &mut self.cycle else { return false };
        if machine & used != 0 || !pattern.may_lead(to) {
            return false;
        }
        pattern.way.push((*to, place));
        true
    }

    /// Ends the cycle at an action that switches something, if stored rapids may be moves to the next hole.
    pub(super) fn settle_way(&mut self, action: &Action) -> Done {
        let leads = matches!(
            action,
            Action::Rapid { .. }
                | Action::Hole(_)
                | Action::CycleOff
                | Action::Length(_)
                | Action::LeftOut(..)
                | Action::LeftOutWord(_)
                | Action::BlockDelete
        );
        match &self.cycle {
            Some(pattern) if !leads && !pattern.way.is_empty() => self.end_cycle(),
            _ => Ok(()),
        }
    }

    pub(super) fn hole(&mut self, hole: &Drilling) -> Done {
        if hole.plane != Plane::Xy {
            let help = "program the moves of the cycle: a job's cycles go along Z";
            return unsaid(self.place.line, "a canned cycle outside G17", help);
        }
        if hole.heights != Heights::Given {
            let message = match hole.heights {
                Heights::Unknown => "the heights of a cycle are relative to an unknown machine position",
                _ => "a cycle returns to an unknown machine height",
            };
            return unsaid(self.place.line, message, "write a rapid with Z before the cycle, or return to R by G99");
        }
        self.low_approach(hole)?;
        self.moves = Some(Moves::of(hole));
        // in a rigid tapping cycle, the control starts the spindle in the direction of the thread
        match hole.cycle.motions {
            Motions::Tap if !self.wanted.turns() => self.wanted.rotation = Some(Rotation::Cw),
            Motions::LeftTap if self.wanted.rotation != Some(Rotation::Ccw) => {
                self.wanted.rotation = Some(Rotation::Ccw)
            }
            _ => {}
        }
        let goes_on = !self.operation && !self.rigid && self.turning.is_none() && self.said == self.wanted;
        let first = match &mut self.cycle {
            Some(pattern) if goes_on && is_same(&pattern.first, hole) && pattern.leads_to(hole) => {
                pattern.way.clear();
                pattern.last = *hole;
                pattern.first
            }
            _ => {
                self.begin_cycle(hole)?;
                *hole
            }
        };
        self.place.point += 1;
        let point = hole_of(hole, &first, self.axes(&hole.at).given);
        self.push(Event::Hole(point))
    }

    fn begin_cycle(&mut self, hole: &Drilling) -> Done {
        self.end_cycle()?;
        // a new tool has already left the reference point at its tool change
        let new_tool = self.operation && self.tool_is_new();
        if let Some(home) = self.home.take().filter(|_| !new_tool) {
            let message = "a cycle begins at an unknown height: at a machine position, or in another work offset";
            return unsaid(home.line, message, "write a rapid with Z before the cycle");
        }
        let spec = spec_of(hole, self.rigid, self.place.line)?;
        self.rigid = false;
        let point = hole_of(hole, hole, self.axes(&hole.at).given);
        self.move_begins(First::Hole(Box::new(spec.clone()), point))?;
        self.step();
        self.place.point = 0;
        self.push(Event::CycleBegin(&spec))?;
        self.cycle = Some(Pattern { first: *hole, last: *hole, way: Vec::new() });
        Ok(())
    }

    /// If the tool is below R, a Fanuc moves across first and then up to R. The cycle of a job moves up first, so this
    /// function adds the move across.
    fn low_approach(&mut self, hole: &Drilling) -> Done {
        let begun = !self.operation && self.home.is_none() && self.known & 0b111 == 0b111;
        let across = self.at[..2] != hole.at[..2];
        if !begun || !across || self.at[2] >= hole.r || self.options.settings.control.is_linuxcnc() {
            return Ok(());
        }
        self.end_cycle()?;
        let mut to = hole.at;
        to[2] = self.at[2];
        self.rapid(&to, 0)
    }

    /// Ends the cycle and adds the rapids that followed its last hole.
    pub(super) fn end_cycle(&mut self) -> Done {
        let Some(pattern) = self.cycle.take() else { return Ok(()) };
        self.place.point = 0;
        self.push(Event::CycleEnd)?;
        let now = self.place;
        for (to, place) in pattern.way {
            (self.place.line, self.place.column) = (place.line, place.column);
            self.rapid(&to, 0)?;
        }
        (self.place.line, self.place.column) = (now.line, now.column);
        Ok(())
    }
}
