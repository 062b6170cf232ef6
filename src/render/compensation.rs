//! Moves that turn cutter compensation on and off.

use super::codes::Shift;
use super::fault::{Done, fault, fault_at};
use super::move_words::AxisUnits;
use super::renderer::{LastMove, Renderer};
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::sema;
use crate::toolpath::{Axes, Infeed, Side};

impl Renderer<'_> {
    /// The move that turns cutter compensation on.
    pub(super) fn infeed(&mut self, infeed: &Infeed, feed: Option<f64>) -> Done {
        let [left, right, _] = self.shape.program.settings.cdc;
        let mirrored = self.shape.scales[1] < 0.0; // a turret on the other side
        let code = if (infeed.side == Side::Left) != mirrored { left } else { right };
        let reversed = |axis: usize| self.shape.letters[self.shape.axes[axis]].reversed;
        if reversed(0) != reversed(1) && left < right {
            let message = "one axis is printed with the other sign, and the offset would be on the other side";
            return fault(Code::PR017, message, "exchange the codes: `CDC 42 41 40`");
        }
        self.vars.set(VarId::Side, code);
        self.compensate(&infeed.to, (feed, infeed.rapid), SequenceId::InFeed, code, true)?;
        self.compensated = true;
        Ok(())
    }

    /// The move that turns it off.
    pub(super) fn outfeed(&mut self, to: &Axes, feed: Option<f64>, rapid: bool) -> Done {
        let off = self.shape.program.settings.cdc[2];
        self.vars.set(VarId::Side, off);
        self.compensate(to, (feed, rapid), SequenceId::OutFeed, off, false)?;
        self.compensated = false;
        Ok(())
    }

    /// `rapid`: the job rapids there; a sequence of the form feeds all the same, which is slower and not wrong.
    fn compensate(
        &mut self,
        to: &Axes,
        (feed, rapid): (Option<f64>, bool),
        id: SequenceId,
        code: f64,
        offset: bool,
    ) -> Done {
        let program = self.shape.program;
        if rapid && program.routine(id).is_some() {
            let message = format!("a rapid with cutter compensation is printed by {}, which may feed", id.name());
            self.out.note(Code::PR022, message, "look at the move");
        }
        let rapid = rapid && program.routine(id).is_none();
        let target = self.reach(to, false)?;
        if self.fresh_tool && !rapid {
            self.begins_somewhere(&target)?;
        }
        if !rapid {
            self.take_feed(feed)?;
        }
        if self.attention {
            self.attend_here(true)?;
        }
        self.stands_at_cut()?;
        self.set_targets(&target)?;
        if self.shape.watches_moves {
            self.upons(super::motion::MOVE_VARS)?;
        }
        if self.shape.measures {
            self.measure(&target, !rapid);
        }
        if let Some(routine) = program.routine(id) {
            let tapers = self.shape.linear == 4 && (2..4).any(|axis| to.get(axis).is_some());
            let blocks =
                routine.ops.clone().filter(|&i| matches!(program.ops[i], crate::compile::Op::Line { .. })).count();
            if tapers && blocks > 1 {
                let message = format!("{} has {blocks} blocks, a four-axis wire takes one", id.name());
                return fault_at(Code::PR008, message, "write the sequence on one line", Some(routine.span));
            }
            self.sequence_says(routine, &target)?;
            // among increments no register holds a height: it is where the moves so far lead
            if program.settings.machine == Machine::Mill
                && !program.settings.incremental
                && !routine.vars.has(VarId::D)
                && self.differs(&target, self.shape.depth_bit())
            {
                let message = format!("nobody knows the height here, and {} does not print it", id.name());
                let help = "put a rapid before it, or the word of [d] into the sequence";
                return fault_at(Code::PR017, message, help, Some(routine.span));
            }
            self.plane_block(17.0, routine)?;
            self.upons(routine.vars)?;
            self.feed_block(&program.settings.feed, routine)?;
            self.run_block(routine)?;
        } else {
            self.enter_plane(17.0)?;
            self.shifted = Shift::None;
            self.motion_word(if rapid { &program.settings.rapid } else { &program.settings.feed })?;
            self.code_word(&sema::Code::plain(b'G', code))?;
            let mut axes = AxisUnits::default();
            self.axis_units(&target, &mut axes)?;
            self.axis_words(&target, &axes)?;
            if offset && program.settings.machine != Machine::Lathe {
                let Some(register) = self.vars.get(VarId::Dcomp) else {
                    self.out.clear_block();
                    let help = "give the tool a \"diameter_offset\"";
                    return fault(Code::PR001, "cutter compensation without an offset register", help);
                };
                self.letter_word(program.settings.cdc_code, register)?;
            }
            if !rapid {
                self.feed_word()?;
            }
            self.out.end_block();
        }
        self.position = target;
        self.last_move = if rapid { LastMove::Rapid } else { LastMove::Line };
        Ok(())
    }
}
