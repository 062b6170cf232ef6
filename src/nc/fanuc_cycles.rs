//! Canned cycles of Fanuc and Haas mills. The values of cycle words are kept until G80, even if the cycle code changes.

use super::action::{Cycle, Drilling, Heights};
use super::arcs::{CENTERS, axes_of};
use super::block::Block;
use super::codes::{AXES, Group, letters};
use super::fault::{Done, refuse};
use super::holes::{Series, Work};
use super::out::Out;
use super::state::State;
use crate::control::{Motions, PitchUnit, Row};
use crate::diag::Code;
use crate::toolpath::{FeedMode, Plane, Units};

impl State {
    /// Makes a cycle active. If no cycle was active before, a new series of holes begins.
    pub(super) fn enter_fanuc_cycle(&mut self, row: &'static Row) {
        if self.holes.cycle.is_none() {
            self.holes.series = Series::default();
        }
        self.holes.cycle = Some(row);
    }

    /// Runs a block while a cycle is active. A block with X, Y, Z or R makes a hole.
    pub(super) fn fanuc_cycle(&mut self, row: &'static Row, block: &Block, out: &mut Out<'_>) -> Done {
        let Some(cycle) = Cycle::of(row) else { return Ok(()) };
        let motions = cycle.motions;
        let [_, _, across] = axes_of(self.modes.plane);
        if !self.holes.series.running {
            self.holes.series.running = true;
            self.holes.series.initial = self.place.position[across];
            self.holes.series.initial_unknown = self.is_unknown(across);
            self.holes.series.initial_elsewhere = false;
        }
        self.keep_cycle_words(block, b"XYZ"[across])?;
        if !block.has(letters("XYZABCR")) {
            return Ok(());
        }
        let series = self.holes.series;
        let (Some(r), Some(bottom)) = (series.r, series.depth) else {
            let what = if series.r.is_none() { "R plane" } else { "depth" };
            let help = "write R and Z in the cycle's first block";
            return refuse(Code::PN007, format!("{} without its {what}", row.code), help);
        };
        let by_pitch = self.tap_by_pitch(row)?;
        self.keep_speed_out(row, block)?;
        self.check_fanuc_cycle(cycle, r, bottom, by_pitch.is_some())?;
        let own = |letter: u8| block.get(letter).filter(|_| row.runs.speed_out != Some(letter));
        let [by_k, by_l] = [own(b'K').filter(|_| !self.k_shifts(motions, block)), own(b'L')];
        if by_k.is_some() && by_l.is_some() {
            return refuse(Code::PN004, "K and L are both numbers of repeats", "write one of the two");
        }
        let times = match by_k.or(by_l) {
            None => 1,
            Some(times) if times.fract() == 0.0 && (0.0..=9999.0).contains(&times) => times as u32,
            Some(times) => {
                return refuse(Code::PN018, format!("{times} is not a number of repeats"), "write K1 to K9999");
            }
        };
        if times == 0 {
            block.takes(AXES); // K0 stores the words of the cycle, and makes no hole at the position
        }
        let clear = match motions {
            Motions::Back => series.initial,
            _ if self.modes.to_initial => series.initial.max(r),
            _ => r,
        };
        let (feed, peck) = by_pitch.unwrap_or((self.drive.feed, series.peck.unwrap_or(0.0)));
        let hole = Drilling {
            cycle,
            at: self.place.position,
            plane: self.modes.plane,
            r,
            bottom,
            clear,
            dwell: series.dwell.filter(|_| cycle.dwells).unwrap_or(0.0),
            peck,
            shift: self.bore_shift(motions),
            level: bottom,
            feed,
            heights: match motions == Motions::Back || self.modes.to_initial {
                _ if series.r_unknown || series.depth_unknown => Heights::Unknown,
                true if series.initial_elsewhere => Heights::Unknown,
                true if series.initial_unknown => Heights::ButClear,
                _ => Heights::Given,
            },
        };
        super::cycles::check_moves(times, &hole)?;
        self.holes.work = Some(Work { hole, times, begun: 0, level: self.place.position[across], depth: None });
        self.make_holes(block, out)
    }

    /// Whether K is the shift of a bore along Z. In G17, K is a number of repeats.
    pub(super) fn k_shifts(&self, motions: Motions, block: &Block) -> bool {
        motions.shifts() && block.plane().unwrap_or(self.modes.plane) != Plane::Xy
    }

    /// The feed and the peck of a tapping cycle that has a separate word for the pitch. `None`: the cycle has no word
    /// for the pitch, and the pitch comes from the feed.
    fn tap_by_pitch(&self, row: &Row) -> Done<Option<(f64, f64)>> {
        let kept = |letter: u8| match letter {
            b'Q' => self.holes.series.peck,
            _ => CENTERS.iter().position(|own| *own == letter).and_then(|axis| self.holes.series.shift[axis]),
        };
        let said = row.pitch.iter().find_map(|pitch| Some((pitch, kept(pitch.letter).filter(|value| *value > 0.0)?)));
        let Some((pitch, value)) = said else { return Ok(None) };
        let peck = self.holes.series.peck.filter(|_| pitch.letter != b'Q').unwrap_or(0.0);
        let units = if pitch.unit == PitchUnit::PerInch { Units::Inch } else { Units::Mm };
        if pitch.unit != PitchUnit::Turn && units != self.modes.units {
            let (letter, units) =
                (char::from(pitch.letter), if units == Units::Inch { "inches" } else { "millimetres" });
            let message = format!("{} takes {letter} only in programs in {units}", row.code);
            return refuse(Code::PN018, message, "write the pitch with the word for the units of the program");
        }
        Ok(Some(match pitch.unit {
            PitchUnit::Turn => (value * self.drive.feed, peck),
            PitchUnit::Mm => (self.by_turns(value), peck),
            PitchUnit::PerInch => (self.by_turns(1.0 / value), peck),
        }))
    }

    /// Stores the spindle speed of a tap on its way out, on controls that have a word for it. The next cycle code ends
    /// this speed.
    fn keep_speed_out(&mut self, row: &Row, block: &Block) -> Done {
        let said = row.runs.speed_out.and_then(|letter| block.get(letter));
        let kept = self.holes.series.speed_out.filter(|_| block.row(Group::Cycle).is_none());
        self.holes.series.speed_out = said.or(kept).filter(|speed| *speed > 0.0);
        if self.holes.series.speed_out.is_some() && self.holes.series.peck.is_some_and(|peck| peck > 0.0) {
            let message = format!("{} with pecks and a speed out of the hole is not simulated", row.code);
            return refuse(Code::PN016, message, "leave out the pecks, or the speed");
        }
        Ok(())
    }

    /// The feed for a pitch, in the unit of the feed mode.
    fn by_turns(&self, pitch: f64) -> f64 {
        if self.modes.feed_mode == FeedMode::PerRev { pitch } else { pitch * self.drive.speed }
    }

    /// Stores the words of a block for the holes of the series. `depth` is the letter of the axis perpendicular to the
    /// plane. Increments are measured from the initial level of the series, and are converted to positions at once.
    ///
    /// # Errors
    /// P is not a dwell that the control reads.
    fn keep_cycle_words(&mut self, block: &Block, depth: u8) -> Done {
        let dwell = block.get(b'P').map(|p| self.seconds(p, block)).transpose()?;
        let initial = self.holes.series.initial;
        let series = &mut self.holes.series;
        let word = |letter: u8| block.get(letter);
        if let Some(r) = word(b'R') {
            series.r = Some(if self.modes.absolute { r } else { initial + r });
            series.r_unknown = !self.modes.absolute && series.initial_unknown;
        }
        if let Some(depth) = word(depth) {
            series.depth = Some(if self.modes.absolute { depth } else { series.r.unwrap_or(initial) + depth });
            let from_unknown = if series.r.is_some() { series.r_unknown } else { series.initial_unknown };
            series.depth_unknown = !self.modes.absolute && from_unknown;
        }
        series.dwell = dwell.or(series.dwell);
        series.peck = word(b'Q').or(series.peck);
        for (axis, letter) in CENTERS.into_iter().enumerate() {
            series.shift[axis] = word(letter).or(series.shift[axis]);
        }
        Ok(())
    }

    /// Refuses a cycle that can't run in the current state of the control, or with these heights.
    fn check_fanuc_cycle(&self, cycle: Cycle, r: f64, bottom: f64, has_feed: bool) -> Done {
        if self.tool.side.is_some() {
            return refuse(
                Code::PN013,
                "a canned cycle under cutter compensation",
                "end the compensation with G40 first",
            );
        }
        if self.modes.feed_mode == FeedMode::InverseTime {
            return refuse(Code::PN013, "a canned cycle under G93", "write G94 and a feed before the cycle");
        }
        if self.drive.feed == 0.0 && !has_feed {
            return refuse(Code::PN008, "a canned cycle without a feed", "write F in the block of the cycle");
        }
        if cycle.motions.shifts() && self.holes.series.peck.is_some_and(|q| q < 0.0) {
            let help = "Q is a distance: a parameter of the control sets its direction";
            return refuse(Code::PN018, format!("{} with a negative Q", cycle.code), help);
        }
        let upward = cycle.motions == Motions::Back;
        if (r < bottom) != upward && r != bottom {
            let message = format!("the R plane {r} is {} the bottom {bottom}", if upward { "above" } else { "below" });
            return refuse(Code::PN011, message, "check R, Z, and G90 or G91");
        }
        if upward && !self.modes.to_initial {
            return refuse(
                Code::PN013,
                format!("{} under G99", cycle.code),
                "a back bore returns to the initial level: write G98",
            );
        }
        Ok(())
    }

    pub(super) fn go_to_hole_of_fanuc(&mut self, work: &mut Work, block: &Block, out: &mut Out<'_>) {
        let [first, second, across] = axes_of(self.modes.plane);
        self.move_over(&[first, second, 3, 4, 5], block, &mut work.hole.at);
        let hole = work.hole;
        self.announce(&hole, out);
        out.by_cycle = true;
        // the tool first moves across at its current height, then down to R
        let height = self.place.position[across];
        self.place.rapid_to(hole.over(height), out);
        let known = self.place.at_machine & 1 << across == 0;
        if hole.cycle.motions != Motions::Back && (height != hole.r || !known) {
            self.rapid_over(&hole, hole.r, out);
        }
    }

    /// The shift away from the wall: Q along the first axis, or I and J.
    fn bore_shift(&self, motions: Motions) -> [f64; 2] {
        if !motions.shifts() {
            return [0.0; 2];
        }
        let [first, second, _] = axes_of(self.modes.plane);
        match [self.holes.series.shift[first], self.holes.series.shift[second]] {
            [None, None] => [self.settings.bore_shift * self.holes.series.peck.unwrap_or(0.0), 0.0],
            shift => shift.map(|value| value.unwrap_or(0.0)),
        }
    }
}
