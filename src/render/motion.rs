//! Rapids and feed moves: the form's sequence, or a generated block of what changed.

use super::codes::Shift;
use super::fault::{Done, fault, fault_at};
use super::move_words::AxisUnits;
use super::numbers::{as_number, tenths};
use super::renderer::{LastMove, Renderer};
use super::words::Mode;
use crate::compile::{LetterKind, Op, Routine};
use crate::control::Group;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId, VarSet};
use crate::number::quantise;
use crate::sema;
use crate::toolpath::{Axes, FeedMode};

/// Variables that a generated move uses.
pub(super) const MOVE_VARS: VarSet = VarSet::of(&[VarId::H, VarId::V, VarId::D, VarId::Frate, VarId::Rotangle]);

/// Variables that remember the position before a move.
pub(super) const LAST_VARS: VarSet =
    VarSet::of(&[VarId::Lasth, VarId::Lastv, VarId::Lastd, VarId::Hdist, VarId::Vdist, VarId::Ddist]);

/// The variables of where the linear axes go, and of how far that is.
pub(super) const NOW: [VarId; 3] = [VarId::H, VarId::V, VarId::D];
pub(super) const MOVED: [VarId; 3] = [VarId::Hdist, VarId::Vdist, VarId::Ddist];

/// Rotary axes in a set of axes, where three axes are linear.
pub(super) const ROTARY: u8 = 0b111_000;

impl Renderer<'_> {
    /// A rapid of the path.
    pub(super) fn rapid(&mut self, to: &Axes) -> Done {
        let target = self.reach(to, true)?;
        if self.shape.sets_targets || self.attention || target.given & ROTARY != 0 {
            self.set_targets(&target)?;
        }
        let turns = target.given & ROTARY != 0 && self.turns(&target);
        if self.attention {
            if turns && self.index_serves_work() {
                self.work_before()?;
            }
            if turns && self.upon_is_due(self.pending(), true) {
                let message = "an Upon sequence would move the tool here before the part turns";
                return fault(Code::PR017, message, "put a rapid that keeps the angle before it");
            }
            self.settle()?;
            self.attention |= self.subs.has_stopped(); // a cut behind it must know its spindle
        }
        self.moved_by = None;
        if turns {
            return self.turn_to(&target);
        }
        if self.shape.watches_moves && self.differs(&target, 0x3f) {
            self.upons(MOVE_VARS.without(VarSet::of(&[VarId::Frate])))?;
        }
        self.rapid_to(&target)
    }

    /// A feed move of the path.
    pub(super) fn line(&mut self, to: &Axes, feed: Option<f64>) -> Done {
        let target = self.reach(to, false)?;
        if self.fresh_tool {
            self.begins_somewhere(&target)?;
        }
        self.take_feed(feed)?;
        if self.attention {
            self.attend_here(true)?;
        } else if self.moved_by.is_some() {
            self.stands_at_cut()?;
        }
        if self.shape.sets_targets || target.given & ROTARY != 0 {
            self.set_targets(&target)?;
        }
        if self.shape.watches_moves && self.differs(&target, 0x3f) {
            self.upons(MOVE_VARS)?;
        }
        self.line_to(&target)
    }

    /// A new tool comes from where nobody knows: its first cut must have a beginning.
    #[cold]
    pub(super) fn begins_somewhere(&mut self, target: &Axes) -> Done {
        // the upper guides of a wire follow the lower ones
        let axes = if self.shape.linear == 4 { 2 } else { self.shape.linear };
        let unknown = target.given & !self.position.given & ((1 << axes) - 1);
        self.fresh_tool = false;
        if unknown == 0 || self.shape.program.settings.incremental {
            return Ok(());
        }
        let help = "begin it with a rapid to the beginning of its first cut";
        fault(Code::PR012, "the operation begins with a cut from where nobody knows", help)
    }

    /// Where an item of the path goes, in the travel of the machine; `free`: out of the part. An open cycle ends before it.
    #[inline]
    pub(super) fn reach(&mut self, to: &Axes, free: bool) -> Done<Axes> {
        if self.cycle.is_some() {
            self.close_cycle()?;
        }
        if self.left.is_some() {
            self.stand_as_left(free)?;
        }
        let target = self.target(to);
        if to.given & ROTARY != 0 { self.in_travel(&target, to.given, free) } else { Ok(target) }
    }

    /// After a cycle that left the tool at another height than the job: a cut begins at the job's.
    #[cold]
    fn stand_as_left(&mut self, free: bool) -> Done {
        let Some((at, height)) = self.left.take() else { return Ok(()) };
        // only where nothing moved the tool or the frame since
        if free || at != self.position || self.pending().has(VarId::Work) {
            return Ok(());
        }
        let mut to = self.position;
        to.set(self.shape.depth, height);
        to.given = self.shape.depth_bit();
        self.set_targets(&to)?;
        self.split_rapid(&to)
    }

    /// A target in program units, with the axes that it keeps.
    #[inline]
    pub(super) fn target(&self, to: &Axes) -> Axes {
        let mut target = self.position;
        for axis in 0..6 {
            if to.given & 1 << axis != 0 {
                let scale = if axis < self.shape.linear { self.shape.scale } else { 1.0 };
                target.values[axis] = to.values[axis] * scale;
            }
        }
        target.given |= to.given;
        target
    }

    /// The variables of a target, and of the position before it.
    #[inline]
    pub(super) fn set_targets(&mut self, target: &Axes) -> Done {
        const UPPER: [VarId; 2] = [VarId::H2, VarId::V2];
        const LAST: [VarId; 3] = [VarId::Lasth, VarId::Lastv, VarId::Lastd];
        if self.shape.linear == 4 {
            for (axis, var) in (2..4).zip(UPPER) {
                self.vars.put(var, target.get(axis));
            }
        }
        for axis in 0..self.shape.linear.min(if self.shape.linear == 4 { 2 } else { 3 }) {
            let bit = 1 << axis;
            if target.given & bit == 0 {
                continue;
            }
            let value = target.values[axis] * self.shape.scales[axis];
            self.vars.set(NOW[axis], value);
            if self.position.given & bit != 0 {
                let before = self.position.values[axis] * self.shape.scales[axis];
                self.vars.set(LAST[axis], before);
                self.vars.set(MOVED[axis], self.as_printed(axis, value) - self.as_printed(axis, before));
            } else {
                self.vars.put(MOVED[axis], None);
            }
        }
        if target.given & ROTARY != 0 {
            self.set_angles(target);
        }
        if !self.shape.program.settings.limits.is_empty() {
            self.check_limits(target)?;
        }
        Ok(())
    }

    /// A value in the digits of its axis: distances between such places add up without a rest.
    #[inline]
    fn as_printed(&self, axis: usize, value: f64) -> f64 {
        let decimals = self.shape.letters[self.shape.axes[axis]].format.dec.count;
        quantise(value, decimals).map_or(value, |units| as_number(units, decimals))
    }

    /// The position variables where the tool is, for a sequence that stands between moves.
    pub(super) fn set_here(&mut self) -> Done {
        let here = self.position;
        if self.shape.sets_targets { Ok(()) } else { self.set_targets(&here) }
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
        let feed = if self.feed_mode == FeedMode::InverseTime { feed } else { feed * self.shape.scale };
        self.keep_feed(Some(feed));
    }

    /// A feed in program units, for the moves that follow.
    pub(super) fn keep_feed(&mut self, feed: Option<f64>) {
        let info = &self.shape.letters[self.shape.program.settings.feed_code];
        self.feed = feed;
        self.feed_units = feed.and_then(|feed| quantise(feed, info.format.dec.count));
        self.vars.put(VarId::Frate, feed);
    }

    /// Inverse time: every feed block says its own.
    #[inline]
    pub(super) fn inverse_time(&self) -> bool {
        self.feed_mode == FeedMode::InverseTime
    }

    /// The same before something that is done where the tool is. `cuts`: an Upon that moves the tool would leave out
    /// a part of the cut.
    #[cold]
    pub(super) fn attend_here(&mut self, cuts: bool) -> Done {
        for var in [VarId::H, VarId::V, VarId::D] {
            self.vars.put(var, None);
        }
        let here = self.position;
        self.set_targets(&here)?;
        if cuts {
            self.knows_after_stop()?;
        }
        self.settle()?;
        if cuts { self.stands_at_cut() } else { Ok(()) }
    }

    /// A cut begins where the path says, not where a sequence took the tool.
    pub(super) fn stands_at_cut(&self) -> Done {
        match self.moved_by {
            Some(span) => {
                let message = "this sequence takes the tool away, and the path goes on with a cut";
                fault_at(Code::PR012, message, "put a rapid to the beginning of the cut before it", Some(span))
            }
            None => Ok(()),
        }
    }

    /// What stands between events and the next move.
    #[cold]
    pub(super) fn attend(&mut self) -> Done {
        self.knows_after_stop()?;
        self.settle()
    }

    /// Changes that wait are printed.
    fn settle(&mut self) -> Done {
        self.attention = false;
        self.pending_changes()?;
        self.check_distance()
    }

    /// Positions are not printed where they would be read as increments, nor the other way round.
    pub(super) fn check_distance(&self) -> Done {
        if self.distance_is_wrong() {
            let [increments, positions] = self.shape.program.settings.inc_abs;
            let (now, needed, read) = match self.shape.program.settings.incremental {
                true => (positions, increments, "increments as positions"),
                false => (increments, positions, "positions as increments"),
            };
            let message = format!("the control is in G{now} here, and would read {read}");
            let help = format!("print G{needed} in the sequence that printed G{now}, after the words that need it");
            return fault(Code::PR017, message, help);
        }
        Ok(())
    }

    /// A sequence that prints words of axes before a G90 or G91 of its own prints them in the mode that is in force.
    pub(super) fn check_distance_of(&self, routine: &Routine) -> Done {
        for i in routine.ops.clone() {
            let letter = match self.shape.program.ops[i] {
                Op::Var { letter, .. } => letter,
                Op::Literal { index, .. } => {
                    let literal = &self.shape.program.literals[index as usize];
                    if literal.letter == b'G' && self.shape.program.settings.inc_abs.contains(&literal.value) {
                        return Ok(());
                    }
                    literal.letter
                }
                _ => continue,
            };
            if self.shape.letters[letter].kind == LetterKind::Axis && !self.shape.program.settings.incremental {
                return self.check_distance();
            }
        }
        Ok(())
    }

    /// A rapid to a target in program units, as one block or, under VRapid, split.
    pub(super) fn rapid_to(&mut self, target: &Axes) -> Done {
        if self.shape.program.settings.depth_rapid.is_some()
            && self.shape.linear == 3
            && self.changes_depth_and_plane(target)
        {
            return self.split_rapid(target);
        }
        self.rapid_block(target, None)
    }

    /// A rapid that goes up first or down last: between holes, and under VRapid.
    pub(super) fn split_rapid(&mut self, target: &Axes) -> Done {
        let code = self.shape.program.settings.depth_rapid.clone();
        if !self.changes_depth_and_plane(target) {
            let depth_only = target.given & self.shape.depth_bit() != 0 && self.differs(target, self.shape.depth_bit());
            return self.rapid_block(target, code.filter(|_| depth_only));
        }
        // only the axes of each part: the others stay where they are, printed or not
        let depth = self.shape.depth_bit();
        let part = |axes: u8| Axes { given: target.given & axes, ..*target };
        if self.is_below(target) {
            self.rapid_block(&part(depth), code)?;
            self.rapid_block(target, None)
        } else {
            self.rapid_block(&part(!depth), None)?;
            self.rapid_block(target, code)
        }
    }

    /// Is the tool below a target, by what the job said last? From an unknown height it comes from above.
    pub(super) fn is_below(&self, target: &Axes) -> bool {
        let from = self.position.get(self.shape.depth).or(self.left_at);
        from.is_some_and(|from| target.values[self.shape.depth] > from)
    }

    fn changes_depth_and_plane(&self, target: &Axes) -> bool {
        self.differs(target, self.shape.depth_bit()) && self.differs(target, 0x3f & !self.shape.depth_bit())
    }

    /// Does a target differ on one of these axes from what was printed?
    pub(super) fn differs(&self, target: &Axes, axes: u8) -> bool {
        (0..6).any(|axis| {
            let bit = 1 << axis;
            if axes & target.given & bit == 0 {
                return false;
            }
            let info = &self.shape.letters[self.shape.axes[axis]];
            let value = target.values[axis] * self.shape.scales[axis];
            quantise(if info.reversed { -value } else { value }, info.format.dec.count)
                .is_none_or(|units| !self.registers.holds(info.printed, units, info.format.dec.count))
        })
    }

    pub(super) fn rapid_block(&mut self, target: &Axes, code: Option<sema::Code>) -> Done {
        let program = self.shape.program;
        // the depth part under VRapid has its own code, which the sequence can't print
        match program.routine(SequenceId::RapidCode).filter(|_| code.is_none()) {
            Some(routine) if self.differs(target, 0x3f) => {
                let mut whole = self.position;
                for axis in (0..6).filter(|axis| target.given & 1 << axis != 0) {
                    whole.set(axis, target.values[axis]);
                }
                self.set_targets(&whole)?;
                self.measure(target, false);
                self.sequence_says(routine, target)?;
                self.upons(routine.vars)?;
                self.motion_block(&program.settings.rapid, routine)?;
                self.shifted = Shift::None;
                self.run(routine.ops.clone(), Mode::Motion)?;
            }
            Some(_) => {}
            None => {
                self.shifted = Shift::None;
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
    pub(super) fn move_to(&mut self, target: &Axes) {
        for axis in 0..6 {
            if target.given & 1 << axis != 0 {
                self.position.values[axis] = target.values[axis];
            }
        }
        self.position.given |= target.given;
    }

    /// A feed move to a target in program units.
    pub(super) fn line_to(&mut self, target: &Axes) -> Done {
        let program = self.shape.program;
        if self.last_move == LastMove::Rapid && !program.settings.force.is_empty() {
            self.force();
        }
        if self.shape.measures {
            self.measure(target, true);
        }
        match program.routine(SequenceId::LineCode) {
            Some(routine) if self.differs(target, 0x3f) => {
                self.sequence_says(routine, target)?;
                self.upons(routine.vars)?;
                self.feed_block(&program.settings.feed, routine)?;
                self.shifted = Shift::None;
                self.run(routine.ops.clone(), Mode::Motion)?;
            }
            Some(_) => {}
            None => {
                self.shifted = Shift::None;
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
        let mut axes = AxisUnits::default();
        self.axis_units(target, &mut axes)?;
        if axes.changed == 0 || (self.shape.program.settings.incremental && !self.has_increment(target)?) {
            return Ok(false);
        }
        self.motion_word(code)?;
        self.axis_words(target, &axes)?;
        if feeds {
            self.feed_word()?;
        }
        self.out.end_block();
        Ok(true)
    }

    /// The letters of `Force` print again.
    pub(super) fn force(&mut self) {
        for &letter in &self.shape.program.settings.force {
            self.registers.forget(self.shape.letters[letter].printed);
        }
    }

    /// Is this motion code the one in force?
    pub(super) fn motion_in_force(&self, code: &sema::Code) -> bool {
        self.registers.group(Group::Motion) == Some(tenths(code.value))
    }
}
