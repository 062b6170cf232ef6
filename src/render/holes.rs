//! One hole: its heights and variables, and the form's sequence for it.

use super::codes::Shift;
use super::cycles::no_height;
use super::fault::{Done, fault};
use super::motion::ROTARY;
use super::numbers::{as_number, quantised};
use super::renderer::Renderer;
use super::words::Mode;
use crate::compile::{CycleStyle, LetterKind, Op, Routine};
use crate::cycle::Plan;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId, VarSet};
use crate::toolpath::{Axes, CycleKind, FeedMode, Hole, impossible};

/// Heights that differ by less are one.
const SAME: f64 = 1e-9;

/// The heights of a hole as depth positions.
#[derive(Clone, Copy)]
pub(super) struct Heights {
    pub(super) point: f64,
    pub(super) clear: f64,
    pub(super) bottom: f64,
    pub(super) return_plane: f64,
}

impl Heights {
    /// Each further start of a thread begins a part of its lead lower: the spindle has turned on by then.
    fn of_start(self, start: u32, starts: u32, planes: &Plan) -> Done<Heights> {
        if start == 0 {
            return Ok(self);
        }
        let Some(lead) = planes.lead else {
            let help = "give the operation a spindle speed";
            return fault(Code::PC009, "a tap of several starts, and the spindle does not turn", help);
        };
        let clear = self.clear - lead * f64::from(start) / f64::from(starts);
        let returns = self.return_plane > self.clear + SAME;
        Ok(Heights { clear, return_plane: if returns { self.return_plane } else { clear }, ..self })
    }
}

impl Renderer<'_> {
    /// A hole of the open cycle.
    pub(super) fn hole(&mut self, hole: &Hole) -> Done {
        if !self.shape.program.printed.has(VarId::Lasthole) {
            return self.make_hole(hole);
        }
        let place = self.out.place;
        let Some(cycle) = &mut self.cycle else { return impossible("a hole outside a cycle") };
        match cycle.held.replace((*hole, place)) {
            Some((before, at)) => {
                self.out.place = at;
                let made = self.make_hole(&before);
                self.out.place = place;
                made
            }
            None => Ok(()),
        }
    }

    /// Prints a hole.
    pub(super) fn make_hole(&mut self, hole: &Hole) -> Done {
        let program = self.shape.program;
        let (scale, rpm) = (self.shape.scale, self.vars.get(VarId::Speed));
        let per_rev = self.feed_mode == FeedMode::PerRev;
        let point = hole.at.get(self.shape.depth).map(|d| d * scale);
        let Some(cycle) = &mut self.cycle else { return impossible("a hole outside a cycle") };
        let mut planes = Plan::of(&cycle.spec, hole.depth.map(|d| d * scale), &self.shape.defaults, rpm)?;
        if per_rev {
            planes.lead = Some(planes.feed);
        }
        let starts = cycle.spec.starts.unwrap_or(1.0).max(1.0) as u32;
        let Some(point) = point.or(cycle.point) else { return no_height() };
        cycle.point = Some(point);
        let clear = point + planes.clear;
        let first = *cycle.return_plane.get_or_insert(point + cycle.spec.return_height.unwrap_or(planes.clear));
        let heights = Heights { point, clear, bottom: point + planes.bottom, return_plane: first.max(clear) };
        let routine = cycle.sequence.and_then(|id| program.routine(id));
        let mut target = self.target(&hole.at);
        if hole.at.given & ROTARY != 0 {
            if self.turns(&self.unwound(&target, hole.at.given)) {
                self.leave_cycle()?; // before an axis is unwound
            }
            target = self.in_travel(&target, hole.at.given, true)?;
        }
        target.set(self.shape.depth, heights.bottom);
        if !self.shape.program.settings.limits.is_empty() {
            self.check_limits(&target)?;
        }
        target.set(self.shape.depth, heights.return_plane);
        for axis in (0..2).filter(|&axis| axis != self.shape.depth) {
            if target.get(axis).is_none() {
                return fault(
                    Code::PR006,
                    "the hole's position is unknown",
                    "give both coordinates of the first point",
                );
            }
        }
        let lost = routine.is_some_and(|routine| self.sequence_loses(routine, &target));
        if self.turns(&target) || lost {
            // no cycle turns the part: the control leaves it, and begins it again there
            self.leave_cycle()?;
            self.set_targets(&target)?;
            if self.attention {
                self.attend()?;
            }
            match program.routine(SequenceId::Index).filter(|_| self.turns(&target)) {
                Some(_) => self.turn_to(&target)?,
                None => self.split_rapid(&target)?,
            }
        }
        self.moved_by = None; // every hole is approached by rapids
        match routine {
            Some(routine) => {
                for start in 0..starts {
                    let heights = heights.of_start(start, starts, &planes)?;
                    target.set(self.shape.depth, heights.return_plane);
                    self.sequence_hole(routine, &target, &planes, heights)?;
                }
            }
            None => self.generated_hole(&target, &planes, heights)?,
        }
        if let Some(cycle) = &mut self.cycle {
            cycle.holes += 1;
            // a manual cycle stays where it stopped
            cycle.left = (cycle.spec.kind != CycleKind::Manual).then_some(heights.return_plane);
        }
        Ok(())
    }

    /// Does a hole lie at a place across the tool that its sequence does not print, as on a lathe?
    fn sequence_loses(&self, routine: &Routine, target: &Axes) -> bool {
        let mut across = (0..2).filter(|&axis| axis != self.shape.depth);
        across.any(|axis| target.get(axis) != self.position.get(axis) && !self.says_axis(routine, axis))
    }

    /// Variables of a cycle at a hole.
    pub(super) fn hole_variables(&mut self, planes: &Plan, heights: Heights) {
        let rigid = self.cycle.as_ref().is_some_and(|cycle| self.is_rigid(&cycle.spec));
        let Some(cycle) = &self.cycle else { return };
        let spec = &cycle.spec;
        let settings = &self.shape.program.settings;
        let vars = &mut self.vars;
        let [r_level, initial_level] = settings.return_plane;
        let higher = heights.return_plane > heights.clear + SAME;
        vars.set(VarId::Retplane, if higher { initial_level } else { r_level });
        vars.set(VarId::D, heights.bottom);
        vars.set(VarId::Pointd, heights.point);
        vars.set(VarId::Vclear, heights.clear);
        vars.set(VarId::Rplane, heights.return_plane);
        vars.set(VarId::Depth, heights.point - heights.bottom);
        vars.set(VarId::Frate, planes.feed);
        vars.set(VarId::Plunge, spec.plunge.unwrap_or(planes.feed));
        // without a step the cycle goes down in one
        let step = spec.step.or(self.shape.defaults.step).or(Some(heights.clear - heights.bottom));
        vars.put(VarId::Vbite, step);
        vars.put(VarId::Peck1, spec.first_step.or(step));
        vars.put(VarId::Inidep, spec.first_step.or(step));
        vars.set(VarId::Sbite, spec.min_step.unwrap_or(self.shape.defaults.min_step));
        let back = spec.back.unwrap_or(match spec.kind {
            CycleKind::Chipbreak => self.shape.defaults.back_chipbreak,
            CycleKind::Thru => self.shape.defaults.back_thru,
            _ => self.shape.defaults.back_deep,
        });
        vars.set(VarId::Sclear, back);
        vars.set(VarId::Vleave, back);
        vars.set(VarId::Sleave, spec.offset.unwrap_or(self.shape.defaults.jog));
        let unit = if settings.dwell.milliseconds { 1000.0 } else { 1.0 };
        vars.put(VarId::Dwell, planes.dwell.map(|seconds| seconds * unit));
        vars.set(VarId::Rigid, f64::from(u8::from(rigid)));
        let per_rev = self.feed_mode == FeedMode::PerRev;
        let rpm = vars.get(VarId::Speed).filter(|&rpm| rpm > 0.0);
        let pitch = if per_rev { Some(planes.feed) } else { rpm.map(|rpm| planes.feed / rpm) };
        vars.put(VarId::Pitch, pitch.filter(|_| spec.kind.is_tap()));
    }

    /// A hole by a sequence of the form.
    fn sequence_hole(&mut self, routine: &Routine, target: &Axes, planes: &Plan, heights: Heights) -> Done {
        self.set_targets(target)?;
        self.attend_hole(routine)?; // with [d] at the return plane: an Upon must not go down the hole
        self.hole_variables(planes, heights);
        self.vars.set(VarId::D, heights.return_plane);
        let used = routine.vars.without(VarSet::of(&[VarId::D]));
        if self.upon_is_due(used, false) {
            self.leave_cycle()?; // else the control takes its words for those of a hole
            self.attend_between(target, planes, heights)?;
        }
        self.upons(used)?;
        self.upon_bottom(routine, target, planes, heights)?;
        self.plane_block(17.0, routine)?; // else the control drills along another axis
        self.vars.set(VarId::D, heights.bottom);
        if matches!(routine.style, CycleStyle::Emulated) {
            self.raise_to(target)?;
            if !self.cycle.as_ref().is_some_and(|cycle| cycle.in_force) {
                self.attend_between(target, planes, heights)?; // what Cancel switched is put back
            }
            self.vars.set(VarId::D, heights.bottom);
            self.registers.forget_letters();
            self.way_to_hole(routine)?;
            self.shifted = Shift::None;
            self.run(routine.ops.clone(), Mode::Hole)?;
            if let Some(cycle) = &mut self.cycle {
                cycle.in_force = routine.stays;
            }
            // after a cycle of the control the last height printed is its bottom
            let cycled = self.says_code(routine, b'G', |code| self.is_cycle(code));
            let exit = match self.stays_at_clearance(routine, heights) {
                true => (heights.clear, true),
                false => (heights.return_plane, false),
            };
            return self.left_hole(target, cycled.then_some(exit));
        }
        let starts = self.starts_cycle(routine, heights);
        if starts {
            self.cancel()?;
            self.attend_between(target, planes, heights)?; // what Cancel switched is put back
            self.approach(target)?;
            self.vars.set(VarId::D, heights.bottom);
            self.warn_of_return(routine, heights);
            let snapshot = self.vars.clone();
            if let Some(cycle) = &mut self.cycle {
                cycle.setup = snapshot;
                cycle.initial_level = heights.return_plane;
                cycle.in_force = true;
            }
        }
        self.shifted = Shift::None;
        match routine.style {
            CycleStyle::Advanced => {
                self.registers.forget_letters();
                if starts {
                    self.run(routine.ops.start..routine.repeat, Mode::All)?;
                    if !self.drills_at_once(routine) {
                        self.registers.forget_letters(); // the first hole needs its lines whole
                    }
                }
                self.run(routine.repeat..routine.ops.end, Mode::Hole)?;
            }
            CycleStyle::Machine if !starts => {
                let position = !self.changes_position(routine)?;
                self.run(routine.ops.clone(), Mode::NextHole { position })?;
            }
            _ => self.run(routine.ops.clone(), Mode::All)?,
        }
        let initial = self.cycle.as_ref().map_or(heights.return_plane, |cycle| cycle.initial_level);
        // with [retplane] the code says whether it returns: G98 where the job goes higher, else G99
        let higher = heights.return_plane > heights.clear + SAME;
        let returns = routine.returns && (higher || !routine.vars.has(VarId::Retplane));
        let exit = if returns { initial.max(heights.clear) } else { heights.clear };
        // without a code that says it, the control's own setting decides whether it returns
        let stays = self.says_code(routine, b'G', |code| code == self.shape.program.settings.return_plane[0]);
        let low = heights.return_plane <= heights.clear + SAME;
        let known = routine.returns || stays || low && initial <= heights.clear + SAME;
        self.left_hole(target, Some((exit, known)))
    }

    /// Does an emulated sequence leave the tool at the clearance for certain: G99, and no axis behind the control's cycle?
    fn stays_at_clearance(&self, routine: &Routine, heights: Heights) -> bool {
        let code = self.shape.program.settings.return_plane[0];
        let chosen = routine.vars.has(VarId::Retplane) && heights.return_plane <= heights.clear + SAME;
        if !chosen && !self.says_code(routine, b'G', |value| value == code) {
            return false;
        }
        let is_line = |i: &usize| matches!(self.shape.program.ops[*i], Op::Line { .. });
        let cycle = routine.ops.clone().rfind(|&i| match self.shape.program.ops[i] {
            Op::Literal { index, .. } => {
                let literal = &self.shape.program.literals[index as usize];
                literal.letter == b'G' && self.is_cycle(literal.value)
            }
            _ => false,
        });
        let Some(end) = cycle.and_then(|cycle| (cycle..routine.ops.end).find(is_line)) else { return true };
        !self.names_axes(&Routine { ops: end..routine.ops.end, ..routine.clone() }, false)
    }

    /// An Upon of the hole's bottom, unless it would take the tool there.
    fn upon_bottom(&mut self, routine: &Routine, target: &Axes, planes: &Plan, heights: Heights) -> Done {
        const BOTTOM: VarSet = VarSet::of(&[VarId::D]);
        self.vars.set(VarId::D, heights.bottom);
        if !routine.vars.has(VarId::D) || !self.upon_is_due(BOTTOM, false) || self.upon_is_due(BOTTOM, true) {
            return Ok(());
        }
        self.leave_cycle()?; // else the control takes its words for those of a hole
        self.attend_between(target, planes, heights)?;
        self.vars.set(VarId::D, heights.bottom);
        self.upons(BOTTOM)
    }

    /// The way to a hole of an emulated cycle is a rapid, also where its first block with axis words says no motion.
    fn way_to_hole(&mut self, routine: &Routine) -> Done {
        let program = self.shape.program;
        let is_line = |i: &usize| matches!(program.ops[*i], Op::Line { .. });
        let moves = |i: usize| {
            let letter = match program.ops[i] {
                Op::Var { letter, .. } => letter,
                Op::Literal { index, .. } => program.literals[index as usize].letter,
                _ => return false,
            };
            self.shape.letters[letter].kind == LetterKind::Axis
        };
        let Some(first) = routine.ops.clone().find(|&i| moves(i)) else { return Ok(()) };
        let end = (first..routine.ops.end).find(is_line).unwrap_or(routine.ops.end);
        let begin = Routine { ops: routine.ops.start..end, ..routine.clone() };
        if !self.says_own_motion(&begin) {
            self.motion_block(&program.settings.rapid, &begin)?;
        }
        Ok(())
    }

    /// Do the first lines of a counted cycle drill a hole themselves? K0 and L0 keep the control from it.
    fn drills_at_once(&self, routine: &Routine) -> bool {
        let typed = |asked: &dyn Fn(u8, f64) -> bool| {
            (routine.ops.start..routine.repeat).any(|i| match self.shape.program.ops[i] {
                Op::Literal { index, .. } => {
                    let literal = &self.shape.program.literals[index as usize];
                    asked(literal.letter, literal.value)
                }
                _ => false,
            })
        };
        typed(&|letter, value| letter == b'G' && self.is_cycle(value))
            && !typed(&|letter, value| matches!(letter, b'K' | b'L') && value == 0.0)
    }

    /// What stands between holes. While the control is in its cycle nothing may come there: it would be taken for a hole, and
    /// what differs from the job is what the sequence itself switched, as `G95` for a tap. It waits for Cancel.
    fn attend_hole(&mut self, routine: &Routine) -> Done {
        if !self.attention {
            return Ok(());
        }
        let in_force = self.cycle.as_ref().is_some_and(|cycle| cycle.in_force);
        match in_force && (routine.cancel || self.says_code(routine, b'G', |code| self.is_cycle(code))) {
            // positions in a form of increments are right if the sequence says G90
            true if self.shape.program.settings.incremental => Ok(()),
            true => self.check_distance(),
            false => self.attend(),
        }
    }

    /// The control has left its cycle before a hole: what stands between moves, with the hole's own values after it.
    fn attend_between(&mut self, target: &Axes, planes: &Plan, heights: Heights) -> Done {
        self.set_targets(target)?;
        if self.attention {
            self.attend()?;
        }
        self.hole_variables(planes, heights);
        self.vars.set(VarId::D, heights.return_plane);
        Ok(())
    }

    /// Must the whole cycle be printed at this hole?
    fn starts_cycle(&self, routine: &Routine, heights: Heights) -> bool {
        let Some(cycle) = &self.cycle else { return true };
        if !cycle.in_force {
            return true;
        }
        // the control would rapid there through the material
        let level = cycle.last.and_then(|last| last.get(self.shape.depth));
        if level.is_none_or(|level| heights.clear > level + SAME) {
            return true;
        }
        routine.style == CycleStyle::Advanced
            && routine.setup_vars.iter().any(|var| cycle.setup.get(var) != self.vars.get(var))
    }

    /// Does a word of the position change at this hole? A block without one would drill on no control, or only on some.
    fn changes_position(&self, routine: &Routine) -> Done<bool> {
        for i in routine.ops.clone() {
            let crate::compile::Op::Var { letter, var, .. } = self.shape.program.ops[i] else { continue };
            let (info, Some(value)) = (&self.shape.letters[letter], self.vars.get(var)) else { continue };
            if info.kind != LetterKind::Axis {
                continue;
            }
            let units = quantised(info, value)?;
            if !self.registers.holds(info.printed, units, info.format.dec.count) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Before a control's cycle: the tool goes to the return plane, up first or down last.
    fn approach(&mut self, target: &Axes) -> Done {
        if !self.differs(target, self.shape.depth_bit()) {
            return Ok(());
        }
        if self.is_below(target) { self.raise(target) } else { self.split_rapid(target) }
    }

    /// An emulated cycle's first line may go across: the tool must not be below the return plane then.
    fn raise_to(&mut self, target: &Axes) -> Done {
        let below = self.is_below(target) && self.differs(target, self.shape.depth_bit());
        let across = (0..2).any(|axis| axis != self.shape.depth && self.position.get(axis) != target.get(axis));
        if !below || !across {
            return Ok(());
        }
        self.cancel()?; // else the control takes the rapid for a hole
        self.raise(target)
    }

    pub(super) fn raise(&mut self, target: &Axes) -> Done {
        let above = Axes { given: self.shape.depth_bit(), ..*target };
        self.set_targets(&above)?;
        self.split_rapid(&above)?;
        self.set_targets(target)
    }

    fn warn_of_return(&mut self, routine: &Routine, heights: Heights) {
        if heights.return_plane > heights.clear + SAME && !routine.returns {
            let message = format!("the job returns to {}, the cycle stays at {}", heights.return_plane, heights.clear);
            self.out.note(
                Code::PR013,
                message,
                "print `G[retplane]` in the cycle, so that the control knows where to return to",
            );
        }
    }

    /// Where the tool is after a hole; `exit` is the height, if the sequence does not print it, and whether it is sure.
    pub(super) fn left_hole(&mut self, target: &Axes, exit: Option<(f64, bool)>) -> Done {
        let mut last = *target;
        let depth = &self.shape.letters[self.shape.axes[self.shape.depth]];
        let (exit, known) = exit.unwrap_or_else(|| match self.registers.get(depth.printed) {
            Some((units, decimals)) => {
                let value = as_number(units, decimals);
                (if depth.reversed { -value } else { value }, true)
            }
            None => (target.values[self.shape.depth], false),
        });
        // what the job means by its last position is the return plane, also where the control stays lower
        last.set(self.shape.depth, exit);
        self.position = last;
        if let Some(cycle) = &mut self.cycle {
            cycle.last = Some(last);
            cycle.exit_known = known;
        }
        Ok(())
    }
}
