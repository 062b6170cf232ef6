//! Rapids and feed moves: the form's sequence, or a generated block of what changed.

use super::fault::{Done, fault, fault_at};
use super::renderer::{LastMove, Renderer};
use super::words::{Mode, tenths};
use crate::compile::{LetterKind, Program};
use crate::diag::Code;
use crate::lang::{Group, SequenceId, VarId, VarSet};
use crate::number::{POWERS, quantise};
use crate::sema;
use crate::toolpath::{Axes, FeedMode, Infeed, Side};

/// Variables that a generated move uses.
pub(super) const MOVE_VARS: VarSet = VarSet::of(&[VarId::H, VarId::V, VarId::D, VarId::Frate, VarId::Rotangle]);

/// Variables that need the length of each move.
pub(super) const MEASURES: VarSet =
    VarSet::of(&[VarId::Movelength, VarId::Movetime, VarId::Totalcutdist, VarId::Totalcuttime, VarId::Invtime]);

/// Variables that remember the position before a move.
const LAST_VARS: VarSet =
    VarSet::of(&[VarId::Lasth, VarId::Lastv, VarId::Lastd, VarId::Hdist, VarId::Vdist, VarId::Ddist]);

/// Must every move set the position variables? Else they are set when a sequence is about to print.
pub(super) fn tracks(program: &Program) -> bool {
    let moves = [SequenceId::RapidCode, SequenceId::LineCode, SequenceId::CwCode, SequenceId::CcwCode];
    program.printed.with(program.upon_vars).meets(LAST_VARS)
        || moves.iter().any(|&id| program.block(id).is_some())
        || !program.settings.limits.is_empty()
        || program.upon_vars.meets(MOVE_VARS)
}

/// Linear axes in a set of axes.
const LINEAR: u8 = 0b111;

impl Renderer<'_> {
    /// A rapid of the path.
    pub(super) fn rapid(&mut self, to: &Axes) -> Done {
        let target = self.target(to);
        if self.cycle.is_some() {
            self.close_cycle()?;
        }
        if self.tracks || self.attention {
            self.set_targets(&target)?;
        }
        if self.attention {
            self.attend()?;
        }
        self.rapid_to(&target)
    }

    /// A feed move of the path.
    pub(super) fn line(&mut self, to: &Axes, feed: Option<f64>) -> Done {
        let target = self.target(to);
        if self.cycle.is_some() {
            self.close_cycle()?;
        }
        self.take_feed(feed)?;
        if self.tracks || self.attention {
            self.set_targets(&target)?;
        }
        if self.attention {
            self.attend()?;
        }
        self.line_to(&target)
    }

    /// A target in program units, with the axes that it keeps.
    #[inline]
    pub(super) fn target(&self, to: &Axes) -> Axes {
        let mut target = self.position;
        for axis in 0..3 {
            if to.given & 1 << axis != 0 {
                target.values[axis] = to.values[axis] * self.scale;
            }
        }
        if to.given & !LINEAR != 0 {
            for axis in 3..6 {
                if to.given & 1 << axis != 0 {
                    target.values[axis] = to.values[axis];
                }
            }
        }
        target.given |= to.given;
        target
    }

    /// The variables of a target, and of the position before it.
    #[inline]
    pub(super) fn set_targets(&mut self, target: &Axes) -> Done {
        const NOW: [VarId; 3] = [VarId::H, VarId::V, VarId::D];
        const LAST: [VarId; 3] = [VarId::Lasth, VarId::Lastv, VarId::Lastd];
        const MOVED: [VarId; 3] = [VarId::Hdist, VarId::Vdist, VarId::Ddist];
        for axis in 0..3 {
            let bit = 1 << axis;
            if target.given & bit == 0 {
                continue;
            }
            let value = target.values[axis];
            self.vars.set(NOW[axis], value);
            if self.position.given & bit != 0 {
                let before = self.position.values[axis];
                self.vars.set(LAST[axis], before);
                self.vars.set(MOVED[axis], value - before);
            }
        }
        if !self.program.settings.limits.is_empty() {
            self.check_limits(target)?;
        }
        Ok(())
    }

    /// The position variables where the tool is, for a sequence that stands between moves.
    pub(super) fn set_here(&mut self) -> Done {
        let here = self.position;
        if self.tracks { Ok(()) } else { self.set_targets(&here) }
    }

    /// The feed of a move: its own, which the next ones keep.
    #[inline]
    pub(super) fn take_feed(&mut self, feed: Option<f64>) -> Done {
        if let Some(feed) = feed {
            self.set_feed(feed);
        }
        if self.feed.is_none() {
            return fault(Code::PR011, "the move has no feed", "give a `feed` here, or one for the whole operation");
        }
        Ok(())
    }

    #[inline]
    pub(super) fn set_feed(&mut self, feed: f64) {
        let feed = if self.feed_mode == FeedMode::InverseTime { feed } else { feed * self.scale };
        self.keep_feed(Some(feed));
    }

    /// A feed in program units, for the moves that follow.
    pub(super) fn keep_feed(&mut self, feed: Option<f64>) {
        let info = &self.letters[self.program.settings.feed_code];
        self.feed = feed;
        self.feed_units = feed.and_then(|feed| quantise(feed, info.format.dec.count));
        self.vars.put(VarId::Frate, feed);
    }

    /// Inverse time: every feed block says its own.
    #[inline]
    pub(super) fn inverse_time(&self) -> bool {
        self.feed_mode == FeedMode::InverseTime
    }

    /// What stands between events and the next move.
    #[cold]
    pub(super) fn attend(&mut self) -> Done {
        self.attention = self.watches_moves;
        self.pending_changes()?;
        if self.watches_moves {
            self.upons(MOVE_VARS)?;
        }
        Ok(())
    }

    /// A rapid to a target in program units, as one block or, under VRapid, split.
    pub(super) fn rapid_to(&mut self, target: &Axes) -> Done {
        if self.program.settings.depth_rapid.is_some() && self.changes_depth_and_plane(target) {
            return self.split_rapid(target);
        }
        self.rapid_block(target, None)
    }

    /// A rapid that goes up first or down last: between holes, and under VRapid.
    pub(super) fn split_rapid(&mut self, target: &Axes) -> Done {
        let code = self.program.settings.depth_rapid.clone();
        if !self.changes_depth_and_plane(target) {
            let depth_only = target.given & 0b100 != 0 && self.differs(target, 0b100);
            return self.rapid_block(target, code.filter(|_| depth_only));
        }
        // only the axes of each part: the others stay where they are, printed or not
        let part = |axes: u8| Axes { given: target.given & axes, ..*target };
        if self.is_below(target) {
            self.rapid_block(&part(0b100), code)?;
            self.rapid_block(target, None)
        } else {
            self.rapid_block(&part(!0b100), None)?;
            self.rapid_block(target, code)
        }
    }

    /// Is the tool known to be below a target? From an unknown height it comes from above.
    pub(super) fn is_below(&self, target: &Axes) -> bool {
        let known = self.registers.get(self.letters[self.axes[2]].printed).is_some();
        known && self.position.get(2).is_some_and(|from| target.values[2] > from)
    }

    fn changes_depth_and_plane(&self, target: &Axes) -> bool {
        self.differs(target, 0b100) && self.differs(target, 0b011)
    }

    /// Does a target differ on one of these axes from what was printed?
    pub(super) fn differs(&self, target: &Axes, axes: u8) -> bool {
        (0..6).any(|axis| {
            let bit = 1 << axis;
            if axes & target.given & bit == 0 {
                return false;
            }
            let info = &self.letters[self.axes[axis]];
            let value = if info.reversed { -target.values[axis] } else { target.values[axis] };
            quantise(value, info.format.dec.count)
                .is_none_or(|units| !self.registers.holds(info.printed, units, info.format.dec.count))
        })
    }

    fn rapid_block(&mut self, target: &Axes, code: Option<sema::Code>) -> Done {
        let program = self.program;
        match program.block(SequenceId::RapidCode) {
            Some(block) if self.differs(target, 0x3f) => {
                self.set_targets(target)?;
                self.measure(target, false);
                self.upons(block.vars)?;
                self.shifted = false;
                self.run(block.ops.clone(), Mode::Motion)?;
            }
            Some(_) => {}
            None => {
                self.shifted = false;
                match &code {
                    Some(code) => self.move_block(target, code, false)?,
                    None => self.move_block(target, &program.settings.rapid, false)?,
                };
            }
        }
        self.move_to(target);
        self.last_move = LastMove::Rapid;
        Ok(())
    }

    /// The tool is there now; axes that the target does not give stay.
    #[inline]
    fn move_to(&mut self, target: &Axes) {
        for axis in 0..6 {
            if target.given & 1 << axis != 0 {
                self.position.values[axis] = target.values[axis];
            }
        }
        self.position.given |= target.given;
    }

    /// A feed move to a target in program units.
    pub(super) fn line_to(&mut self, target: &Axes) -> Done {
        let program = self.program;
        if self.last_move == LastMove::Rapid && !program.settings.force.is_empty() {
            self.force();
        }
        if self.measures {
            self.measure(target, true);
        }
        match program.block(SequenceId::LineCode) {
            Some(block) if self.differs(target, 0x3f) => {
                self.upons(block.vars)?;
                self.shifted = false;
                self.run(block.ops.clone(), Mode::Motion)?;
            }
            Some(_) => {}
            None => {
                self.shifted = false;
                self.move_block(target, &program.settings.feed, true)?;
            }
        }
        self.position = *target;
        self.last_move = LastMove::Line;
        Ok(())
    }

    /// A generated block: motion code, axes that changed, feed. Nothing changed, nothing printed.
    #[inline]
    fn move_block(&mut self, target: &Axes, code: &sema::Code, feeds: bool) -> Done<bool> {
        let settings = &self.program.settings;
        let mut units = [0i64; 6];
        let mut changed = 0u8;
        let mut printed = 0u8;
        let mut axes = target.given;
        while axes != 0 {
            let axis = axes.trailing_zeros() as usize;
            axes &= axes - 1;
            let info = &self.letters[self.axes[axis]];
            units[axis] = self.quantised(info, target.values[axis])?;
            if !self.registers.holds(info.printed, units[axis], info.format.dec.count) {
                changed |= 1 << axis;
            } else if !info.modal {
                printed |= 1 << axis;
            }
        }
        if changed == 0 {
            return Ok(false);
        }
        self.motion_word(code)?;
        if settings.incremental {
            self.increments(target, changed)?;
        } else {
            self.axis_words(&units, changed | printed)?;
        }
        if feeds {
            self.feed_word()?;
        }
        self.end_block();
        Ok(true)
    }

    /// The words of these axes.
    #[inline]
    pub(super) fn axis_words(&mut self, units: &[i64; 6], mut axes: u8) -> Done {
        while axes != 0 {
            let axis = axes.trailing_zeros() as usize;
            axes &= axes - 1;
            let info = &self.letters[self.axes[axis]];
            self.put_word(info, units[axis], false)?;
            self.registers.set(info.printed, units[axis], info.format.dec.count);
        }
        Ok(())
    }

    /// Increments between printed positions, so that they add up without a rest.
    pub(super) fn increments(&mut self, target: &Axes, axes: u8) -> Done {
        for axis in 0..6 {
            if axes & 1 << axis == 0 {
                continue;
            }
            let info = &self.letters[self.axes[axis]];
            let Some(from) = self.position.get(axis) else {
                return fault(
                    Code::PR001,
                    format!("an increment of {} from an unknown position", char::from(info.printed)),
                    "begin with a tool change that prints the position",
                );
            };
            let (from, to) = (self.quantised(info, from)?, self.quantised(info, target.values[axis])?);
            if to != from {
                self.put_word(info, to - from, false)?;
            }
            self.registers.set(info.printed, to, info.format.dec.count);
        }
        Ok(())
    }

    /// The motion code, unless it is in force and may be dropped.
    #[inline]
    pub(super) fn motion_word(&mut self, code: &sema::Code) -> Done {
        if self.code_drops(code.letter, code.value) {
            return Ok(());
        }
        self.code_word(code)
    }

    /// A code, as typed in its command or by its letter's format.
    pub(super) fn code_word(&mut self, code: &sema::Code) -> Done {
        let info = &self.letters[code.letter];
        match &code.text {
            Some(text) => self.out.word(&self.layout, false).extend_from_slice(text.as_bytes()),
            None => {
                let units = self.quantised(info, code.value)?;
                self.put_word(info, units, false)?;
            }
        }
        if matches!(info.kind, LetterKind::GCode | LetterKind::MCode) {
            self.printed_code(info.printed, code.value);
        }
        Ok(())
    }

    /// A letter with a value, always printed.
    pub(super) fn letter_word(&mut self, letter: u8, value: f64) -> Done {
        let info = &self.letters[letter];
        let units = self.quantised(info, value)?;
        self.put_word(info, units, false)?;
        self.registers.set(info.printed, units, info.format.dec.count);
        Ok(())
    }

    /// The feed, when it changed; in inverse time always.
    #[inline]
    pub(super) fn feed_word(&mut self) -> Done {
        let info = &self.letters[self.program.settings.feed_code];
        if let Some(units) = self.feed_units
            && self.registers.holds(info.printed, units, info.format.dec.count)
            && info.modal
            && !self.inverse_time()
        {
            return Ok(());
        }
        let Some(feed) = self.feed else { return Ok(()) };
        let units = self.quantised(info, feed)?;
        if units == 0 {
            let message = format!("the feed {feed} prints as 0 in the format `{}`", info.format);
            return fault(Code::PR002, message, "give the letter more decimals");
        }
        self.put_word(info, units, false)?;
        self.registers.set(info.printed, units, info.format.dec.count);
        Ok(())
    }

    /// The letters of `Force` print again.
    pub(super) fn force(&mut self) {
        for &letter in &self.program.settings.force {
            self.registers.forget(self.letters[letter].printed);
        }
    }

    /// Is this motion code the one in force?
    pub(super) fn motion_in_force(&self, code: &sema::Code) -> bool {
        self.registers.group(Group::Motion) == Some(tenths(code.value))
    }

    /// Lengths and times, for forms that print them.
    #[cold]
    pub(super) fn measure(&mut self, target: &Axes, cuts: bool) {
        let mut square = 0.0;
        for axis in 0..3 {
            if let (Some(from), Some(to)) = (self.position.get(axis), target.get(axis)) {
                square += (to - from) * (to - from);
            }
        }
        self.measured(square.sqrt(), cuts);
    }

    /// The same for a length that is known.
    pub(super) fn measured(&mut self, length: f64, cuts: bool) {
        self.vars.set(VarId::Movelength, length);
        let Some(feed) = self.feed.filter(|_| cuts) else { return };
        let minutes = match self.feed_mode {
            FeedMode::PerMinute => length / feed,
            FeedMode::PerRev => length / (feed * self.vars.get(VarId::Speed).unwrap_or(0.0)),
            FeedMode::InverseTime => 1.0 / feed,
        };
        if !minutes.is_finite() {
            return;
        }
        self.vars.set(VarId::Movetime, minutes * 60.0);
        if minutes > 0.0 {
            self.vars.set(VarId::Invtime, 1.0 / minutes);
        }
        let add = |vars: &mut super::vars::Vars, var, value: f64| {
            let sum = vars.get(var).unwrap_or(0.0) + value;
            vars.set(var, sum);
        };
        add(&mut self.vars, VarId::Totalcutdist, length);
        add(&mut self.vars, VarId::Totalcuttime, minutes * 60.0);
    }

    /// Travel limits of the form.
    #[cold]
    fn check_limits(&self, target: &Axes) -> Done {
        for limit in &self.program.settings.limits {
            let Some(axis) = self.axes.iter().position(|&letter| letter == limit.letter) else { continue };
            let Some(value) = target.get(axis) else { continue };
            let scale = if axis < 3 { self.form_scale } else { 1.0 };
            let (least, greatest) = (limit.least * scale, limit.greatest * scale);
            if value < least || value > greatest {
                let letter = char::from(limit.letter);
                let message = format!("{letter}{value} is beyond the travel from {least} to {greatest}");
                return fault_at(Code::PR007, message, "move the part, or mend `Limits` in the form", Some(limit.span));
            }
        }
        Ok(())
    }

    /// The move that turns cutter compensation on.
    pub(super) fn infeed(&mut self, infeed: &Infeed, feed: Option<f64>) -> Done {
        let [left, right, _] = self.program.settings.cdc;
        let code = match infeed.side {
            Side::Left => left,
            Side::Right => right,
        };
        self.vars.set(VarId::Side, code);
        self.compensated(&infeed.to, feed, SequenceId::InFeed, code, true)
    }

    /// The move that turns it off.
    pub(super) fn outfeed(&mut self, to: &Axes, feed: Option<f64>) -> Done {
        let off = self.program.settings.cdc[2];
        self.vars.set(VarId::Side, off);
        self.compensated(to, feed, SequenceId::OutFeed, off, false)
    }

    fn compensated(&mut self, to: &Axes, feed: Option<f64>, id: SequenceId, code: f64, offset: bool) -> Done {
        let program = self.program;
        let target = self.target(to);
        self.close_cycle()?;
        self.take_feed(feed)?;
        self.set_targets(&target)?;
        if self.attention {
            self.attend()?;
        }
        if self.measures {
            self.measure(&target, true);
        }
        if let Some(block) = program.block(id) {
            self.run_with_upons(block)?;
        } else {
            self.shifted = false;
            self.motion_word(&program.settings.feed)?;
            self.code_word(&sema::Code::plain(b'G', code))?;
            let mut units = [0; 6];
            let mut changed = 0;
            for axis in 0..6 {
                if target.given & 1 << axis == 0 {
                    continue;
                }
                let info = &self.letters[self.axes[axis]];
                units[axis] = self.quantised(info, target.values[axis])?;
                let kept = info.modal && self.registers.holds(info.printed, units[axis], info.format.dec.count);
                changed |= u8::from(!kept) << axis;
            }
            if program.settings.incremental {
                self.increments(&target, changed)?;
            } else {
                self.axis_words(&units, changed)?;
            }
            if offset {
                let Some(register) = self.vars.get(VarId::Dcomp) else {
                    self.out.clear_block();
                    let help = "give the tool a \"diameter_offset\"";
                    return fault(Code::PR001, "cutter compensation without an offset register", help);
                };
                self.letter_word(program.settings.cdc_code, register)?;
            }
            self.feed_word()?;
            self.end_block();
        }
        self.position = target;
        self.last_move = LastMove::Line;
        Ok(())
    }
}

/// Units of a letter as a number, for messages and geometry.
pub(super) fn as_number(units: i64, decimals: u8) -> f64 {
    units as f64 / POWERS[usize::from(decimals)] as f64
}
