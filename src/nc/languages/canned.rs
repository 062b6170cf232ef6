//! Makes the holes of cycle calls.

use crate::diag::Code;
use crate::nc::action::{Action, Drilling, Rotation};
use crate::nc::arcs::axes_of;
use crate::nc::call::{Call, Canned, Stand, Step};
use crate::nc::fault::{Done, refuse};
use crate::nc::out::Out;
use crate::nc::state::State;
use crate::toolpath::{FeedMode, StopKind};

impl State {
    /// The state of the control on which a hole depends.
    fn stand(&self) -> Stand {
        Stand {
            at: self.place.position,
            plane: self.modes.plane,
            units: self.modes.units,
            feed: self.drive.feed,
            per_turn: self.modes.feed_mode == FeedMode::PerRev,
            speed: self.drive.speed,
            turning: self.drive.spindle,
            back_off: self.back_off(),
            bore_shift: self.settings.bore_shift,
        }
    }

    /// Makes the hole of a call at the current position of the tool.
    pub(in crate::nc) fn call_cycle(&mut self, call: &Call, out: &mut Out<'_>) -> Done {
        if self.tool.side.is_some() {
            let help = "end the compensation in a block before the cycle";
            return refuse(Code::PN013, "a cycle under cutter compensation", help);
        }
        if self.modes.feed_mode == FeedMode::InverseTime {
            return refuse(Code::PN013, "a cycle under G93", "write G94 and a feed before the cycle");
        }
        match call.plan(&self.stand())? {
            Some(canned) => self.make_canned(&canned, out),
            None => Ok(()),
        }
    }

    /// Moves to the next holes of a pattern and makes them. If the output is full, the next call makes the remaining
    /// holes.
    pub(in crate::nc) fn make_pattern(&mut self, out: &mut Out<'_>) -> Done {
        while let Some(mut pattern) = self.holes.pattern.take() {
            let Some([first, second]) = pattern.at.pop_front() else { return Ok(()) };
            let axes = axes_of(self.modes.plane);
            let mut to = self.place.position;
            (to[axes[0]], to[axes[1]]) = (first, second);
            self.place.given(axes[0]);
            self.place.given(axes[1]);
            out.by_cycle = true;
            self.place.rapid_to(to, out);
            self.call_cycle(&pattern.call, out)?;
            self.holes.pattern = Some(pattern).filter(|pattern| !pattern.at.is_empty());
            if out.is_full() {
                return Ok(());
            }
        }
        Ok(())
    }

    fn make_canned(&mut self, canned: &Canned, out: &mut Out<'_>) -> Done {
        let [first, second, across] = axes_of(self.modes.plane);
        let hole = Drilling { at: self.place.position, plane: self.modes.plane, ..canned.hole };
        self.announce(&hole, out);
        out.by_cycle = true;
        let to_height = |state: &mut State, height: f64| {
            state.place.given(across);
            let mut to = state.place.position;
            to[across] = height;
            to
        };
        for step in &canned.steps {
            match *step {
                Step::Rapid(height) => {
                    let mut to = to_height(self, height);
                    (to[first], to[second]) = (hole.at[first], hole.at[second]);
                    self.place.rapid_to(to, out);
                }
                Step::Top => {
                    let home = self.place.frames.to_program(&self.place.homes[0]);
                    let mut to = self.place.position;
                    to[across] = home[across];
                    self.place.goes_to_machine(1 << across);
                    self.place.rapid_to(to, out);
                }
                Step::Feed(height, feed) if feed > 0.0 => {
                    let to = to_height(self, height);
                    self.place.feed_to(to, feed, None, out);
                }
                Step::Feed(..) => return refuse(Code::PN008, "a cycle without a feed", "write F before the cycle"),
                Step::Dwell(seconds) => out.push(Action::Dwell(seconds)),
                Step::Turn(rotation, speed) => {
                    self.drive.spindle = rotation;
                    out.push(Action::Spindle(rotation, speed));
                }
                Step::Orient(angle) => {
                    self.drive.spindle = Rotation::Stop;
                    out.push(Action::Orient(angle));
                }
                Step::Aside(by) => {
                    let mut to = self.place.position;
                    for (axis, by) in [first, second, across].into_iter().zip(by) {
                        to[axis] += by;
                    }
                    self.place.rapid_to(to, out);
                }
                Step::Stop => out.push(Action::Stop(StopKind::Program)),
            }
        }
        out.by_cycle = false;
        out.push(Action::CycleOff);
        Ok(())
    }
}
