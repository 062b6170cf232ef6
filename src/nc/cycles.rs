//! Canned cycles of LinuxCNC and EMC2: the meaning of their words, and the moves from hole to hole.

use super::action::{Action, Cycle, Drilling, Heights};
use super::arcs::{CENTERS, axes_of};
use super::block::Block;
use super::codes::letters;
use super::fault::{Done, refuse};
use super::holes::Work;
use super::out::Out;
use super::state::State;
use crate::control::{Meaning, Motions, Row, Rules};
use crate::diag::Code;
use crate::toolpath::FeedMode;

/// The value of a word. LinuxCNC marks a missing word by -1.
fn given(word: Option<f64>) -> Option<f64> {
    word.filter(|&value| value != -1.0)
}

impl State {
    /// Runs a cycle. A word that is missing in this block is taken from earlier blocks of the cycle. A word that no
    /// block contains is an error.
    pub(super) fn linuxcnc_cycle(&mut self, row: &'static Row, block: &Block, out: &mut Out<'_>) -> Done {
        self.check_cycle(block)?;
        let same = self.modes.motion.is_some_and(|motion| motion.code == row.code);
        let [_, _, across] = axes_of(self.modes.plane);
        let name = row.code;
        let mode = (self.modes.absolute, self.modes.plane, self.modes.units);
        let kept = self.holes.series;
        let Some(r) = block.get(b'R').or(kept.r.filter(|_| same)) else {
            return refuse(Code::PN007, format!("{name} without its R plane"), "write R in the cycle's first block");
        };
        let times = repeats(block.get(b'L'))?;
        let Some(depth) = self.axis_word(block, across).or(kept.depth.filter(|_| same)) else {
            let axis = char::from(b"XYZ"[across]);
            let help = format!("write {axis} in the cycle's first block");
            return refuse(Code::PN007, format!("{name} without its depth"), help);
        };
        let reused = block.get(b'R').is_none() || self.axis_word(block, across).is_none();
        if same && reused && kept.written.is_some_and(|written| written != mode) {
            self.warnings.push((
                Code::PN030,
                "R or the depth was written before a change of the units, the plane, or G90 and G91; after the change \
                 the same number is used again",
                "write R and the depth again after the change",
            ));
        }
        if !reused {
            self.holes.series.written = Some(mode);
        }
        if !self.holes.series.running || self.control.rules() == Rules::Emc2 {
            self.holes.series.initial = self.place.position[across];
            self.holes.series.initial_unknown = self.is_unknown(across);
        }
        let (initial, unknown) = (self.holes.series.initial, self.holes.series.initial_unknown);
        let (plane_r, bottom) = if self.modes.absolute { (r, depth) } else { (initial + r, initial + r + depth) };
        if plane_r < bottom {
            let message = format!("the R plane {plane_r} is below the bottom {bottom}");
            return refuse(Code::PN011, message, "check R, the depth, and G90 or G91");
        }
        self.holes.series.r = Some(r);
        self.holes.series.depth = Some(depth);
        // if the tool is below R, it first moves straight up to R
        if initial < plane_r && !unknown {
            let mut to = self.place.position;
            to[across] = plane_r;
            out.by_cycle = true;
            self.place.rapid_to(to, out);
        }
        let Some(cycle) = Cycle::of(row) else { return Ok(()) };
        let hole = self.words(cycle, same, block)?;
        let heights = match (unknown, self.modes.absolute) {
            (false, _) => Heights::Given,
            (true, false) => Heights::Unknown,
            (true, true) if self.modes.to_initial => Heights::ButClear,
            (true, true) => Heights::Given,
        };
        let hole = Drilling {
            heights,
            r: plane_r,
            bottom,
            clear: if self.modes.to_initial { initial.max(plane_r) } else { plane_r },
            ..hole
        };
        check_moves(times, &hole)?;
        self.holes.work = Some(Work { hole, times, begun: 0, level: self.place.position[across], depth: None });
        self.modes.motion = Some(row);
        self.holes.series.running = true;
        self.make_holes(block, out)
    }

    /// Makes the holes of a block, one after the other. If the output is full, the next call makes the remaining holes.
    pub(super) fn make_holes(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        while let Some(mut work) = self.holes.work.take() {
            if work.depth.is_none() {
                if work.begun == work.times {
                    return Ok(());
                }
                self.go_to_hole(&mut work, block, out)?;
                work.begun += 1;
            }
            out.by_cycle = true;
            work.depth = self.drill(&work.hole, work.depth, out)?;
            out.by_cycle = false;
            if work.depth.is_some() || work.begun < work.times {
                self.holes.work = Some(work);
            }
            if out.is_full() {
                return Ok(());
            }
        }
        Ok(())
    }

    fn go_to_hole(&mut self, work: &mut Work, block: &Block, out: &mut Out<'_>) -> Done {
        if self.control.is_linuxcnc() {
            self.go_to_hole_of_linuxcnc(work, block, out)
        } else {
            self.go_to_hole_of_fanuc(work, block, out);
            Ok(())
        }
    }

    /// Moves `at` to the next hole. The words of `axes` in the block are positions or increments.
    pub(super) fn move_over(&mut self, axes: &[usize], block: &Block, at: &mut [f64; 6]) {
        for &axis in axes {
            if let Some(value) = self.axis_word(block, axis) {
                if self.modes.absolute {
                    at[axis] = value;
                    self.place.given(axis);
                } else {
                    at[axis] += value;
                    self.place.moves_by(axis, value);
                }
            }
        }
    }

    fn go_to_hole_of_linuxcnc(&mut self, work: &mut Work, block: &Block, out: &mut Out<'_>) -> Done {
        let [first, second, across] = axes_of(self.modes.plane);
        let (begun, level) = (work.begun, work.level);
        let at = &mut work.hole.at;
        // an absolute polar position is the same in each repeat
        if block.polar != [None; 2] && (begun == 0 || !self.modes.absolute) {
            let held = std::mem::replace(&mut self.place.position, *at);
            let done = self.polar(block, at);
            self.place.position = held;
            done?;
        }
        self.move_over(&[first, second], block, at);
        let hole = work.hole;
        self.announce(&hole, out);
        out.by_cycle = true;
        if begun == 0 && (level > hole.r || self.is_unknown(across)) {
            self.place.rapid_to(hole.over(level), out);
            self.rapid_over(&hole, hole.r, out);
            return Ok(());
        }
        let across_too = self.place.position[first] != hole.at[first] || self.place.position[second] != hole.at[second];
        if self.place.position[across] < hole.clear && across_too {
            let message =
                "the rapid to this hole moves up and across at once, because the hole before returned only to R";
            let help = "retract before the change to G98, or use only G98 or only G99 in the whole cycle";
            self.warnings.push((Code::PN031, message, help));
        }
        self.rapid_clear(&hole, out);
        if hole.clear > hole.r || hole.heights != Heights::Given {
            self.rapid_over(&hole, hole.r, out);
        }
        Ok(())
    }

    /// Adds the action of a hole. The actions of the hole's moves follow.
    pub(super) fn announce(&self, hole: &Drilling, out: &mut Out<'_>) {
        out.by_cycle = false;
        let at = hole.over(hole.clear);
        out.push(Action::Hole(Box::new(Drilling { at, ..*hole })));
    }

    fn check_cycle(&self, block: &Block) -> Done {
        if block.has(letters("ABC")) {
            return refuse(Code::PN005, "A, B or C in a canned cycle", "turn the axis in a block before the cycle");
        }
        if self.drive.feed == 0.0 {
            return refuse(Code::PN008, "a canned cycle without a feed", "write F in the block of the cycle");
        }
        if self.modes.feed_mode == FeedMode::InverseTime {
            return refuse(Code::PN013, "a canned cycle under G93", "write G94 and a feed before the cycle");
        }
        if self.tool.side.is_some() {
            return refuse(
                Code::PN013,
                "a canned cycle under cutter compensation",
                "end the compensation with G40 first",
            );
        }
        Ok(())
    }

    /// Takes P, Q and the shift from the block, or their values from earlier blocks. The first block of a cycle must
    /// contain these words.
    fn words(&mut self, cycle: Cycle, same: bool, block: &Block) -> Done<Drilling> {
        let Cycle { code: name, motions, dwells, .. } = cycle;
        let missing = |letter: char| {
            let help = format!("write {letter} in the cycle's first block");
            refuse(Code::PN007, format!("{name} without {letter}"), help)
        };
        let feed = self.drive.feed;
        let mut hole = Drilling {
            cycle,
            at: self.place.position,
            plane: self.modes.plane,
            r: 0.0,
            bottom: 0.0,
            clear: 0.0,
            dwell: 0.0,
            peck: 0.0,
            shift: [0.0; 2],
            level: 0.0,
            feed,
            heights: Heights::Given,
        };
        if dwells {
            let word = given(block.get(b'P'));
            if word.is_none() && !same && !motions.taps() {
                return missing('P');
            }
            if word.is_some() && block.g_meaning(super::codes::Group::Once) == Some(Meaning::Dwell) {
                let help = "write G4 in a block of its own";
                self.warnings.push((Code::PN033, "P is the dwell of both G4 and the cycle", help));
            }
            self.holes.series.dwell = word.or(self.holes.series.dwell);
            hole.dwell = self.holes.series.dwell.unwrap_or(0.0);
        }
        if motions.pecks() {
            let word = given(block.get(b'Q'));
            if word.is_none() && !same {
                return missing('Q');
            }
            self.holes.series.peck = word.or(self.holes.series.peck);
            hole.peck = self.holes.series.peck.unwrap_or(0.0);
        }
        if motions == Motions::Back {
            for (axis, letter) in CENTERS.into_iter().enumerate() {
                let word = block.get(letter);
                if word.is_none() && !same {
                    return missing(char::from(letter));
                }
                self.holes.series.shift[axis] = word.or(self.holes.series.shift[axis]);
            }
            let [first, second, across] =
                axes_of(self.modes.plane).map(|axis| self.holes.series.shift[axis].unwrap_or(0.0));
            hole.shift = [first, second];
            let bottom = self.bottom();
            hole.level = if self.modes.absolute { across } else { bottom + across };
        }
        Ok(hole)
    }

    fn bottom(&self) -> f64 {
        let (r, depth) = (self.holes.series.r.unwrap_or(0.0), self.holes.series.depth.unwrap_or(0.0));
        if self.modes.absolute { depth } else { self.holes.series.initial + r + depth }
    }
}

/// Refuses a block that makes more than a million moves.
pub(super) fn check_moves(times: u32, hole: &Drilling) -> Done {
    let pecks = if hole.peck > 0.0 { ((hole.r - hole.bottom) / hole.peck).abs() } else { 0.0 };
    if f64::from(times) * (pecks + 4.0) > 1e6 {
        return refuse(Code::PN018, "a block that makes more than a million moves", "check its repeats and Q");
    }
    Ok(())
}

/// The number of repeats: the L word, a whole number; 1 without L.
fn repeats(word: Option<f64>) -> Done<u32> {
    let times = word.unwrap_or(1.0);
    let whole = times.round();
    if (times - whole).abs() > 1e-4 || !(1.0..=1e6).contains(&whole) {
        return refuse(Code::PN018, format!("L{times} is not a number of repeats"), "write L1 or more");
    }
    Ok(whole as u32)
}
