//! Rotary axes: another view of the part, and travel that ends.

use super::fault::{Done, fault};
use super::renderer::{LastMove, Renderer};
use crate::diag::Code;
use crate::lang::{Group, SequenceId, VarId};
use crate::toolpath::Axes;

/// The rotary axes among the six.
const ROTARY: std::ops::Range<usize> = 3..6;

impl Renderer<'_> {
    /// A target whose rotary angles are in the travel of their axes: when one would leave it, the tool is taken out,
    /// the axis unwound, and angles count from there. `given`: the axes that the job's own item gives.
    pub(super) fn in_travel(&mut self, target: &Axes, given: u8) -> Done<Axes> {
        let mut inside = *target;
        for axis in ROTARY.filter(|axis| given & 1 << axis != 0) {
            let turn = axis - ROTARY.start;
            let letter = self.axes[axis];
            inside.values[axis] = target.values[axis] - self.wound[turn];
            let Some(limit) = self.program.settings.limits.iter().find(|limit| limit.letter == letter) else {
                continue;
            };
            let within = |angle: f64| (limit.least..=limit.greatest).contains(&angle);
            if within(inside.values[axis]) {
                continue;
            }
            // whole turns come off where the axis stands, so that the move itself turns as far as it should
            let here = self.position.get(axis).unwrap_or(0.0);
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
            self.wound[turn] += turns;
            inside.values[axis] = angle;
        }
        Ok(inside)
    }

    /// Prints Unwind; the tool is back where it was, its angle modulo 360.
    fn unwind(&mut self, axis: usize) -> Done {
        let program = self.program;
        let Some(block) = program.block(SequenceId::Unwind) else {
            let message =
                format!("{} reaches the end of its travel, and the form has no Unwind", char::from(self.axes[axis]));
            return fault(Code::PR007, message, "add Unwind: it lifts the tool, turns the axis back and goes on");
        };
        let here = self.position;
        let last = here.get(axis).unwrap_or(0.0) % 360.0;
        self.set_targets(&here)?;
        for (var, now) in [(VarId::Lasth, 0), (VarId::Lastv, 1), (VarId::Lastd, 2)] {
            self.vars.put(var, here.get(now));
        }
        self.vars.set(VarId::Lastrotangle, last);
        self.vars.set(VarId::Rotangle, last);
        self.registers.forget_all();
        self.run_with_upons(block)?;
        self.registers.forget_group(Group::Motion);
        self.last_move = LastMove::None;
        self.position.set(axis, last);
        Ok(())
    }

    /// A rapid to another rotary view: Index, where the form has it. Whether it was printed.
    pub(super) fn index(&mut self, target: &Axes) -> Done<bool> {
        let program = self.program;
        let turns = |axis: usize| target.get(axis).is_some_and(|angle| angle != self.position.get(axis).unwrap_or(0.0));
        let Some(axis) = ROTARY.into_iter().find(|&axis| turns(axis)) else { return Ok(false) };
        let (from, to) = (self.position.get(axis).unwrap_or(0.0), target.values[axis]);
        self.vars.set(VarId::Lastrotangle, from);
        self.vars.set(VarId::Rotangle, to);
        // up to half a turn the job's angles say which way; a view farther off is reached the shorter way round
        let turn = (to - from + 180.0).rem_euclid(360.0) - 180.0;
        let way = if (to - from).abs() <= 180.0 { to - from } else { turn };
        self.vars.set(VarId::Rotaxdir, if way < 0.0 { -1.0 } else { 1.0 });
        let Some(block) = program.block(SequenceId::Index) else { return Ok(false) };
        self.registers.forget_all();
        self.run_with_upons(block)?;
        self.registers.forget_group(Group::Motion);
        self.position = *target;
        self.last_move = LastMove::None;
        Ok(true)
    }
}
