//! Rotary axes: another view of the part, and travel that ends.

use super::fault::{Done, fault, fault_at};
use super::renderer::{LastMove, Renderer};
use crate::compile::{Op, Routine};
use crate::control::Group;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::toolpath::Axes;

/// The rotary axes among the six, where three are linear.
const ROTARY: std::ops::Range<usize> = 3..6;

/// What is known of the rotary axes; a machine begins with all of them at 0.
#[derive(Clone, Debug)]
pub(super) struct Angles {
    /// Where each stands while the tool's position does not say it.
    stands: [Option<f64>; 3],
    /// Where each goes, for `[rotangle]`.
    now: [Option<f64>; 3],
    /// Where each was before, for `[lastrotangle]`.
    last: [Option<f64>; 3],
    /// Whole turns that Unwind took off each.
    wound: [f64; 3],
}

impl Default for Angles {
    fn default() -> Self {
        let zero = [Some(0.0); 3];
        Angles { stands: zero, now: zero, last: zero, wound: [0.0; 3] }
    }
}

impl Angles {
    /// Nobody knows where they stand. Turns that were taken off stay off.
    pub(super) fn forget(&mut self) {
        (self.stands, self.now, self.last) = ([None; 3], [None; 3], [None; 3]);
    }

    /// They stay where the tool's position says, which is about to be forgotten.
    pub(super) fn keep(&mut self, position: &Axes) {
        for (stands, axis) in self.stands.iter_mut().zip(ROTARY) {
            *stands = position.get(axis).or(*stands);
        }
    }

    /// Is any angle known? In a subprogram: one that it said.
    pub(super) fn is_known(&self) -> bool {
        self.now.iter().any(Option::is_some)
    }

    /// Have turns been taken off?
    pub(super) fn is_wound(&self) -> bool {
        self.wound != [0.0; 3]
    }

    /// Have the same turns been taken off?
    pub(super) fn wound_as(&self, other: &Angles) -> bool {
        self.wound == other.wound
    }
}

impl Renderer<'_> {
    /// A target whose rotary angles are in the travel of their axes: when one would leave it, the tool is taken out,
    /// the axis unwound, and angles count from there. `given`: the axes that the job's own item gives. `free`: the tool is
    /// out of the part, so whole turns more or less are the same view.
    pub(super) fn in_travel(&mut self, target: &Axes, given: u8, free: bool) -> Done<Axes> {
        let mut inside = *target;
        for axis in self.rotary().filter(|axis| given & 1 << axis != 0) {
            let turn = axis - ROTARY.start;
            let letter = self.shape.axes[axis];
            inside.values[axis] = target.values[axis] - self.angles.wound[turn];
            let Some(limit) = self.shape.program.settings.limits.iter().find(|limit| limit.letter == letter) else {
                continue;
            };
            let free = free
                && (self.angles.wound[turn] != 0.0 || !(limit.least..=limit.greatest).contains(&inside.values[axis]));
            let within = |angle: f64| (limit.least..=limit.greatest).contains(&angle);
            if within(inside.values[axis]) && !free {
                continue;
            }
            if free {
                // the nearest of the same views that the axis can reach
                let (raw, here) = (inside.values[axis], self.angle(axis).unwrap_or(0.0));
                let nearest = here + (raw - here + 180.0).rem_euclid(360.0) - 180.0;
                if let Some(angle) = [nearest, nearest - 360.0, nearest + 360.0].into_iter().find(|&a| within(a)) {
                    self.angles.wound[turn] += raw - angle;
                    inside.values[axis] = angle;
                    continue;
                }
            }
            // whole turns come off where the axis stands, so that the move itself turns as far as it should
            let here = self.angle(axis).unwrap_or(0.0);
            let turns = here - here % 360.0;
            let angle = inside.values[axis] - turns;
            if turns == 0.0 || !within(angle) {
                let letter = char::from(letter);
                let message =
                    format!("{letter}{angle} is beyond the travel from {} to {}", limit.least, limit.greatest);
                return fault(
                    Code::PR007,
                    message,
                    "split the move, or turn the other way: no unwinding brings it into the travel",
                );
            }
            self.unwind(axis)?;
            self.angles.wound[turn] += turns;
            inside.values[axis] = angle;
        }
        Ok(inside)
    }

    /// A target less the whole turns that were taken off.
    pub(super) fn unwound(&self, target: &Axes, given: u8) -> Axes {
        let mut inside = *target;
        for axis in self.rotary().filter(|axis| given & 1 << axis != 0) {
            inside.values[axis] -= self.angles.wound[axis - ROTARY.start];
        }
        inside
    }

    /// Prints Unwind; the tool is back where it was, its angle modulo 360.
    fn unwind(&mut self, axis: usize) -> Done {
        let program = self.shape.program;
        let letter = char::from(self.shape.axes[axis]);
        let Some(routine) = program.routine(SequenceId::Unwind) else {
            let message = format!("{letter} reaches the end of its travel, and the form has no Unwind");
            return fault(Code::PR007, message, "add Unwind: it lifts the tool, turns the axis back and goes on");
        };
        if self.compensated {
            let help = "end the compensation with an `outfeed` before";
            return fault(Code::PR006, "a rotary axis is unwound under cutter compensation", help);
        }
        if !self.says_angle(routine, axis) {
            let message = format!("{letter} is to be unwound, and Unwind does not print its angle");
            return fault_at(Code::PR017, message, format!("print `{letter}[lastrotangle]`"), Some(routine.span));
        }
        let mut here = self.position;
        here.set(axis, self.angle(axis).unwrap_or(0.0) % 360.0);
        self.set_targets(&here)?;
        for (var, now) in [(VarId::Lasth, 0), (VarId::Lastv, 1), (VarId::Lastd, 2)] {
            self.vars.put(var, here.get(now));
        }
        self.angles.last[axis - ROTARY.start] = here.get(axis);
        self.vars.put(VarId::Lastrotangle, here.get(axis));
        self.run_elsewhere(routine)?;
        self.position.set(axis, here.values[axis]);
        Ok(())
    }

    /// A sequence that may leave the path and come back: only what it prints is known afterwards.
    fn run_elsewhere(&mut self, routine: &Routine) -> Done {
        self.registers.forget_all();
        self.placed = 0;
        self.run_with_upons(routine)?;
        self.registers.forget_group(Group::Motion);
        self.last_move = LastMove::None;
        Ok(())
    }

    /// The job tilts the tool. A form has words for rotary axes, not for the kinematics that a vector needs.
    pub(super) fn tilt(&mut self, axis: [f64; 3]) -> Done {
        if axis == [0.0, 0.0, 1.0] {
            return Ok(());
        }
        let [i, j, k] = axis;
        let message = format!("the tool is tilted to {i:.6}, {j:.6}, {k:.6}, and a form has no words for that");
        fault(Code::PR008, message, "render the parts of the job that keep the tool upright")
    }

    /// Where a rotary axis stands.
    pub(super) fn angle(&self, axis: usize) -> Option<f64> {
        self.position.get(axis).or(self.angles.stands[axis - ROTARY.start])
    }

    /// The rotary axes of this machine.
    fn rotary(&self) -> std::ops::Range<usize> {
        if self.shape.linear == ROTARY.start { ROTARY } else { 0..0 }
    }

    /// Does a target turn the part?
    #[inline]
    pub(super) fn turns(&self, target: &Axes) -> bool {
        self.turned_axes(target).next().is_some()
    }

    /// The rotary axes that a target turns.
    pub(super) fn turned_axes(&self, target: &Axes) -> impl Iterator<Item = usize> {
        self.rotary().filter(move |&axis| target.get(axis).is_some() && target.get(axis) != self.angle(axis))
    }

    /// The variables of a target's rotary angles.
    #[cold]
    pub(super) fn set_angles(&mut self, target: &Axes) {
        for axis in self.rotary() {
            let (Some(to), turn) = (target.get(axis), axis - ROTARY.start) else { continue };
            let from = self.angle(axis);
            self.angles.last[turn] = from;
            self.angles.now[turn] = Some(to);
            if from == Some(to) {
                continue;
            }
            self.vars.put(VarId::Lastrotangle, from);
            self.vars.set(VarId::Rotangle, to);
            // up to half a turn the job's angles say which way; a view farther off is reached the shorter way round
            let way = from.map(|from| match to - from {
                way if way.abs() <= 180.0 => way,
                way => (way + 180.0).rem_euclid(360.0) - 180.0,
            });
            self.vars.put(VarId::Rotaxdir, way.map(|way| if way < 0.0 { -1.0 } else { 1.0 }));
        }
    }

    /// The angle that a letter prints: its own axis', for `[rotangle]` and `[lastrotangle]`.
    pub(super) fn angle_of(&self, var: VarId, letter: u8) -> Option<f64> {
        let axis = self.rotary().find(|&axis| self.shape.axes[axis] == letter)?;
        let angles = if var == VarId::Rotangle { &self.angles.now } else { &self.angles.last };
        angles[axis - ROTARY.start]
    }

    /// A rapid to another rotary view: Index, where the form has it.
    pub(super) fn turn_to(&mut self, target: &Axes) -> Done {
        let program = self.shape.program;
        let Some(routine) = program.routine(SequenceId::Index) else { return self.rapid_to(target) };
        if let Some(axis) = self.turned_axes(target).find(|&axis| !self.says_angle(routine, axis)) {
            let letter = char::from(self.shape.axes[axis]);
            let message = format!("{letter} turns to {}, which Index does not print", target.values[axis]);
            return fault_at(Code::PR017, message, format!("add `{letter}[rotangle]` to Index"), Some(routine.span));
        }
        // one that does not take the tool up itself would turn the part under it
        if target.get(self.shape.depth).is_some() && !self.names_axes(routine, true) && self.is_below(target) {
            self.raise(target)?;
        }
        self.sequence_goes_down(routine, target)?;
        self.run_elsewhere(routine)?;
        let placed = self.placed;
        self.move_to(&Axes { given: target.given & placed, ..*target });
        let left = Axes { given: target.given & !placed, ..*target };
        match left.given {
            0 => Ok(()),
            // over a hole first, down last
            _ if self.cycle.is_some() => self.split_rapid(&left),
            _ => self.rapid_to(&left),
        }
    }

    /// A sequence that goes down must first go everywhere else that the target says.
    fn sequence_goes_down(&self, routine: &Routine, target: &Axes) -> Done {
        if routine.vars.has(VarId::D) { self.sequence_says(routine, target) } else { Ok(()) }
    }

    /// What a tool change prints of its first target: rotary axes only where it has a word for them. One that goes
    /// down must have it: else the part would turn against the tool.
    pub(super) fn change_turns(&mut self, routine: &Routine, target: &Axes, given: u8) -> Done<Axes> {
        let down = routine.ops.clone().find(|&i| matches!(self.shape.program.ops[i], Op::Var { var: VarId::D, .. }));
        let before = Routine { ops: routine.ops.start..down.unwrap_or(routine.ops.end), ..routine.clone() };
        let says = |axis: &usize| self.says_angle(&before, *axis);
        let lost = self.turned_axes(target).find(|axis| !says(axis));
        if let Some(axis) = lost.filter(|_| routine.vars.has(VarId::D)) {
            let (letter, angle) = (char::from(self.shape.axes[axis]), target.values[axis]);
            let message =
                format!("the tool begins at {letter}{angle}, and the tool change goes down before the part turns");
            let help = format!("print `{letter}[rotangle]` in the tool change, before the height");
            return fault_at(Code::PR017, message, help, Some(routine.span));
        }
        let unsaid = self.rotary().filter(|axis| !says(axis)).fold(0, |axes, axis| axes | 1 << axis);
        // only what the first move gives: another tool keeps no position
        let target = Axes { given: given & !unsaid, ..*target };
        self.in_travel(&target, given & !unsaid, true)
    }
}
