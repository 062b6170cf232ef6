//! The moves of a canned cycle at a hole, from the moment when the tool is above the hole.

use super::action::{Action, Drilling, Heights, Position, Rotation};
use super::arcs::axes_of;
use super::fault::{Done, refuse};
use super::out::Out;
use super::state::State;
use crate::control::{Motions, Rules};
use crate::diag::Code;
use crate::toolpath::{FeedMode, StopKind};

impl Drilling {
    /// The position at a height on the axis of the hole.
    #[inline]
    pub fn over(&self, height: f64) -> Position {
        let mut to = self.at;
        to[axes_of(self.plane)[2]] = height;
        to
    }

    /// The position at a height, shifted sideways in the plane by the shift of the hole.
    fn beside(&self, height: f64) -> Position {
        let mut to = self.over(height);
        let [first, second, _] = axes_of(self.plane);
        to[first] += self.shift[0];
        to[second] += self.shift[1];
        to
    }
}

impl State {
    /// Switches the spindle for a cycle.
    fn turn(&mut self, rotation: Rotation, out: &mut Out<'_>) {
        out.push(Action::Spindle(rotation, self.drive.speed));
    }

    /// The rapid into a hole after a peck stops at this distance above the depth reached so far.
    pub(super) fn back_off(&self) -> f64 {
        self.settings.back_off_in(self.modes.units)
    }

    /// Records that the tool moves to a height of the hole. `clear`: the height is the return level.
    fn comes_to(&mut self, hole: &Drilling, clear: bool) {
        let [_, _, across] = axes_of(hole.plane);
        match hole.heights {
            Heights::Unknown => self.place.strays(1 << across),
            Heights::ButClear if clear => self.place.goes_to_machine(1 << across),
            Heights::Given | Heights::ButClear => self.place.given(across),
        }
    }

    #[inline]
    pub(super) fn rapid_over(&mut self, hole: &Drilling, height: f64, out: &mut Out<'_>) {
        self.comes_to(hole, false);
        self.place.rapid_to(hole.over(height), out);
    }

    /// Makes a rapid to the return level of the cycle.
    #[inline]
    pub(super) fn rapid_clear(&mut self, hole: &Drilling, out: &mut Out<'_>) {
        self.comes_to(hole, true);
        self.place.rapid_to(hole.over(hole.clear), out);
    }

    #[inline]
    fn feed_over(&mut self, hole: &Drilling, height: f64, out: &mut Out<'_>) {
        self.comes_to(hole, false);
        self.place.feed_to(hole.over(height), hole.feed, None, out);
    }

    fn feed_clear(&mut self, hole: &Drilling, out: &mut Out<'_>) {
        self.comes_to(hole, true);
        self.place.feed_to(hole.over(hole.clear), hole.feed, None, out);
    }

    fn rapid_beside(&mut self, hole: &Drilling, height: f64, out: &mut Out<'_>) {
        self.comes_to(hole, false);
        self.place.rapid_to(hole.beside(height), out);
    }

    fn clear_beside(&mut self, hole: &Drilling, out: &mut Out<'_>) {
        self.comes_to(hole, true);
        self.place.rapid_to(hole.beside(hole.clear), out);
    }

    /// Makes the moves of a hole, from R to the return level. `from`: the depth at which the next peck ends, if an
    /// earlier call has begun the hole. If this call reaches the limit of actions, the function returns the depth at
    /// which the next peck ends.
    pub(super) fn drill(&mut self, hole: &Drilling, from: Option<f64>, out: &mut Out<'_>) -> Done<Option<f64>> {
        let emc2 = self.control.rules() == Rules::Emc2;
        match hole.cycle.motions {
            Motions::Drill => {
                self.feed_over(hole, hole.bottom, out);
                if hole.cycle.dwells {
                    out.push(Action::Dwell(hole.dwell));
                }
                self.rapid_clear(hole, out);
            }
            Motions::Peck | Motions::Chipbreak => return self.pecks(hole, from, out),
            Motions::Tap | Motions::LeftTap => return self.tap(hole, from, out),
            Motions::FeedOut => {
                self.feed_over(hole, hole.bottom, out);
                if hole.cycle.dwells {
                    out.push(Action::Dwell(hole.dwell));
                }
                // LinuxCNC feeds out to the return level only in cycles that dwell; by its manual, EMC2 always does
                if emc2 || hole.cycle.dwells && self.control.is_linuxcnc() {
                    self.feed_clear(hole, out);
                } else {
                    self.feed_over(hole, hole.r, out);
                    self.rapid_clear(hole, out);
                }
            }
            Motions::StopOut => {
                let turning = self.turning(hole)?;
                self.feed_over(hole, hole.bottom, out);
                out.push(Action::Dwell(hole.dwell));
                self.turn(Rotation::Stop, out);
                self.rapid_clear(hole, out);
                self.turn(turning, out);
            }
            Motions::Back => self.back_bore(hole, out)?,
            Motions::ByHand => {
                let turning = self.turning(hole)?;
                self.feed_over(hole, hole.bottom, out);
                out.push(Action::Dwell(hole.dwell));
                self.turn(Rotation::Stop, out);
                out.push(Action::Stop(StopKind::Program));
                if self.control.is_linuxcnc() {
                    self.warnings.push((
                        Code::PN034,
                        "G88 does not retract: the simulation assumes that the operator retracts the tool before the \
                         next hole",
                        "use G86, or retract by hand",
                    ));
                    self.comes_to(hole, true);
                    self.place.position = hole.over(hole.clear);
                } else {
                    self.rapid_clear(hole, out);
                }
                self.turn(turning, out);
            }
            Motions::ShiftOut => self.fine_bore(hole, out),
        }
        Ok(None)
    }

    /// Drills in pecks: G73 retracts a little to break the chip, G83 retracts out of the hole to clear the chips.
    fn pecks(&mut self, hole: &Drilling, from: Option<f64>, out: &mut Out<'_>) -> Done<Option<f64>> {
        if hole.peck <= 0.0 {
            return refuse(Code::PN018, format!("a peck of {}", hole.peck), "Q must be greater than zero");
        }
        check_pecks(hole)?;
        if self.control.rules() == Rules::Emc2 && hole.cycle.motions == Motions::Peck {
            return Ok(self.pecks_of_emc2(hole, from, out));
        }
        let back_off = self.back_off();
        if from.is_none() && hole.peck < back_off {
            self.warnings.push((
                Code::PN032,
                "a peck is shorter than the back-off of the control: the rapid after it ends above the start of this \
                 peck",
                "take longer pecks, or set the back-off of the control with `--back-off`",
            ));
        }
        let mut depth = from.unwrap_or(hole.r - hole.peck);
        while depth > hole.bottom {
            if out.is_full() {
                return Ok(Some(depth));
            }
            self.feed_over(hole, depth, out);
            if hole.cycle.motions == Motions::Peck {
                self.rapid_over(hole, hole.r, out);
            }
            self.rapid_over(hole, depth + back_off, out);
            depth -= hole.peck;
        }
        self.feed_over(hole, hole.bottom, out);
        if hole.dwell > 0.0 && !self.control.is_linuxcnc() {
            out.push(Action::Dwell(hole.dwell));
        }
        self.rapid_clear(hole, out);
        Ok(None)
    }

    /// Pecks as in EMC2: a dwell of a quarter of a second, a retract to the return level, and a feed move down to the last depth.
    fn pecks_of_emc2(&mut self, hole: &Drilling, from: Option<f64>, out: &mut Out<'_>) -> Option<f64> {
        // the depth at which the last peck ended
        let mut depth = from.unwrap_or(hole.r);
        // a remainder that comes from rounding is not a peck
        while depth > hole.bottom + 1e-9 {
            if out.is_full() {
                return Some(depth);
            }
            depth = (depth - hole.peck).max(hole.bottom);
            self.feed_over(hole, depth, out);
            out.push(Action::Dwell(0.25));
            self.rapid_clear(hole, out);
        }
        None
    }

    /// The direction in which the spindle turns. A stopped spindle is an error.
    fn turning(&self, hole: &Drilling) -> Done<Rotation> {
        if self.drive.spindle == Rotation::Stop {
            return refuse(
                Code::PN012,
                format!("{} with the spindle stopped", hole.cycle.code),
                "write M3 or M4 before the cycle",
            );
        }
        Ok(self.drive.spindle)
    }

    fn tap(&mut self, hole: &Drilling, from: Option<f64>, out: &mut Out<'_>) -> Done<Option<f64>> {
        let inwards = if hole.cycle.motions == Motions::Tap { Rotation::Cw } else { Rotation::Ccw };
        let linuxcnc = self.control.is_linuxcnc();
        if linuxcnc && self.turning(hole)? != inwards {
            let help = "a right-hand tap needs M3, a left-hand tap M4";
            return refuse(Code::PN012, format!("{} with the wrong spindle direction", hole.cycle.code), help);
        }
        let outwards = inwards.reversed();
        if from.is_none() && !linuxcnc && self.drive.spindle != inwards {
            self.turn(inwards, out);
        }
        let rest = self.tap_pecks(hole, from, [inwards, outwards], out)?;
        if rest.is_some() {
            return Ok(rest);
        }
        self.feed_over(hole, hole.bottom, out);
        if linuxcnc {
            self.turn(Rotation::Stop, out);
            self.turn(outwards, out);
            out.push(Action::Dwell(hole.dwell));
        } else {
            wait(hole, out);
        }
        if linuxcnc {
            self.feed_clear(hole, out);
            self.turn(Rotation::Stop, out);
        } else {
            self.tap_out(hole, outwards, out);
        }
        self.turn(inwards, out);
        if !linuxcnc {
            self.drive.spindle = inwards;
            self.rapid_clear(hole, out);
        }
        Ok(None)
    }

    /// Moves a tap out of its hole, on a Fanuc. Some cycles have a speed for this move. The pitch stays the same.
    fn tap_out(&mut self, hole: &Drilling, outwards: Rotation, out: &mut Out<'_>) {
        let speed = self.holes.series.speed_out.unwrap_or(self.drive.speed);
        let faster = if self.modes.feed_mode == FeedMode::PerRev { 1.0 } else { speed / self.drive.speed };
        let feed = if faster.is_finite() { hole.feed * faster } else { hole.feed };
        out.push(Action::Spindle(outwards, speed));
        self.feed_over(&Drilling { feed, ..*hole }, hole.r, out);
    }

    /// Q of a tap on a Fanuc: after each peck the tap turns back a little to break the chip.
    fn tap_pecks(
        &mut self,
        hole: &Drilling,
        from: Option<f64>,
        [inwards, outwards]: [Rotation; 2],
        out: &mut Out<'_>,
    ) -> Done<Option<f64>> {
        if self.control.is_linuxcnc() || hole.peck <= 0.0 {
            return Ok(None);
        }
        check_pecks(hole)?;
        let back_off = self.back_off();
        let mut depth = from.unwrap_or(hole.r - hole.peck);
        while depth > hole.bottom {
            if out.is_full() {
                return Ok(Some(depth));
            }
            self.feed_over(hole, depth, out);
            self.turn(outwards, out);
            self.feed_over(hole, (depth + back_off).min(hole.r), out);
            self.turn(inwards, out);
            depth -= hole.peck;
        }
        Ok(None)
    }

    /// Orients the spindle, moves the tool sideways away from the wall, and retracts.
    fn leave_aside(&mut self, hole: &Drilling, turning: Rotation, out: &mut Out<'_>) {
        self.turn(Rotation::Stop, out);
        out.push(Action::Orient(None));
        self.rapid_beside(hole, hole.bottom, out);
        self.clear_beside(hole, out);
        self.rapid_clear(hole, out);
        self.turn(turning, out);
    }

    /// Back boring: the shifted tool moves down through the hole, then moves to the axis of the hole and feeds up.
    fn back_bore(&mut self, hole: &Drilling, out: &mut Out<'_>) -> Done {
        let turning = self.turning(hole)?;
        if !self.control.is_linuxcnc() {
            // on a Fanuc, R is below the part and Z is above R: the tool is still at the initial level here
            self.turn(Rotation::Stop, out);
            out.push(Action::Orient(None));
            self.clear_beside(hole, out);
            self.rapid_beside(hole, hole.r, out);
            self.rapid_over(hole, hole.r, out);
            self.turn(turning, out);
            self.feed_over(hole, hole.bottom, out);
            wait(hole, out);
            self.leave_aside(hole, turning, out);
            return Ok(());
        }
        self.rapid_beside(hole, hole.r, out);
        self.turn(Rotation::Stop, out);
        out.push(Action::Orient(None));
        self.rapid_beside(hole, hole.bottom, out);
        self.rapid_over(hole, hole.bottom, out);
        self.turn(turning, out);
        self.feed_over(hole, hole.level, out);
        self.feed_over(hole, hole.bottom, out);
        self.leave_aside(hole, turning, out);
        Ok(())
    }

    /// Fine boring, G76 of a Fanuc mill.
    fn fine_bore(&mut self, hole: &Drilling, out: &mut Out<'_>) {
        let turning = self.drive.spindle;
        self.feed_over(hole, hole.bottom, out);
        wait(hole, out);
        self.leave_aside(hole, turning, out);
    }
}

/// Refuses a hole with more than a million pecks, because a control would need days for the hole.
fn check_pecks(hole: &Drilling) -> Done {
    if (hole.r - hole.bottom) / hole.peck > 1e6 {
        return refuse(Code::PN018, format!("Q{} makes more than a million pecks", hole.peck), "write a larger Q");
    }
    Ok(())
}

/// Dwells at the bottom of a hole, unless the time is zero.
fn wait(hole: &Drilling, out: &mut Out<'_>) {
    if hole.dwell > 0.0 {
        out.push(Action::Dwell(hole.dwell));
    }
}
