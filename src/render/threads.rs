//! Threads on a lathe: the control's cycle, a cycle of one pass each, or passes made here.

use super::cycles::cycle_fault;
use super::fault::{Done, fault};
use super::renderer::{LastMove, Renderer};
use super::words::Mode;
use crate::compile::Block;
use crate::cycle::thread_passes;
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::sema;
use crate::toolpath::{Axes, Thread};

/// A thread in program units, radii as radii.
struct Cut {
    /// End along the axis.
    end: f64,
    /// Radius of the crest at the end.
    crest: f64,
    /// Which way the passes go: -1 to the centre, 1 away from it.
    inward: f64,
    passes: Vec<f64>,
    lead: f64,
    taper: f64,
}

impl Renderer<'_> {
    /// A thread of the path. AutoThread goes before CanThread, both before passes made here.
    pub(super) fn thread(&mut self, thread: &Thread) -> Done {
        let program = self.program;
        self.close_cycle()?;
        if program.settings.machine != Machine::Lathe {
            return fault(Code::PR008, "threads are for lathes", "mill the thread by its moves, or tap it");
        }
        if !self.vars.get(VarId::Direct).is_some_and(|code| code != program.settings.spindle[2]) {
            return fault(Code::PR006, "the spindle does not turn", "give the operation a spindle with a direction");
        }
        let cut = self.cut(thread)?;
        let starts = thread.starts.unwrap_or(1.0);
        let begin = self.target(&thread.from).get(0);
        self.thread_variables(thread, &cut);
        for start in 0..starts as u32 {
            // each start begins one pitch further back
            let back = f64::from(start) * thread.pitch * self.scale;
            if let Some(begin) = begin {
                let mut at = self.position;
                at.set(0, begin + back * if begin >= cut.end { 1.0 } else { -1.0 });
                self.set_targets(&at)?;
                if self.attention {
                    self.attend()?;
                }
                self.rapid_to(&at)?;
            }
            let here = self.position;
            match (program.block(SequenceId::AutoThread), program.block(SequenceId::CanThread)) {
                (Some(block), _) => {
                    self.pass_variables(&cut, cut.passes[cut.passes.len() - 1])?;
                    self.run_with_upons(block)?;
                }
                (None, Some(block)) => self.canned_passes(block, &cut)?,
                (None, None) => self.own_passes(&cut, &here)?,
            }
            self.registers.forget_all();
            self.position = here;
            self.last_move = LastMove::None;
        }
        let feed = self.feed;
        self.keep_feed(feed);
        Ok(())
    }

    fn cut(&self, thread: &Thread) -> Done<Cut> {
        let from = self.target(&thread.from);
        let to = self.target(&thread.to);
        let (Some(start), Some(end)) = (from.get(1), to.get(0)) else {
            return fault(
                Code::PR006,
                "the thread's start or end is unknown",
                "give both coordinates of `from`, and z of `to`",
            );
        };
        let crest = if thread.to.given & 0b10 != 0 { to.values[1] } else { start };
        let depth = thread.depth.abs() * self.scale;
        let first = thread.first_depth.map(|d| d * self.scale);
        let least = thread.min_depth.unwrap_or(0.0) * self.scale;
        let passes = thread_passes(depth, first, thread.passes.map(|n| n as usize), least).or_else(cycle_fault)?;
        Ok(Cut {
            end,
            crest,
            inward: if thread.depth < 0.0 { 1.0 } else { -1.0 },
            passes,
            lead: thread.pitch * thread.starts.unwrap_or(1.0) * self.scale,
            taper: thread.taper.map_or(start - crest, |taper| taper * self.scale),
        })
    }

    fn thread_variables(&mut self, thread: &Thread, cut: &Cut) {
        let first = cut.passes[0];
        let depth = thread.depth.abs() * self.scale;
        let angle = thread.angle.unwrap_or(60.0);
        self.vars.set(VarId::Pitch, thread.pitch * self.scale);
        self.vars.set(VarId::Frate, cut.lead);
        self.vars.set(VarId::Depth, depth);
        self.vars.set(VarId::Peck1, first);
        self.vars.set(VarId::Vbite, thread.min_depth.unwrap_or(0.0) * self.scale);
        self.vars.set(VarId::Vleave, 0.0);
        self.vars.set(VarId::Taper, cut.taper);
        self.vars.set(VarId::Passes, thread.passes.unwrap_or(cut.passes.len() as f64));
        self.vars.set(VarId::Chams, thread.chamfer.unwrap_or(0.0));
        self.vars.set(VarId::Tipang, angle);
        self.vars.set(VarId::Startang, angle / 2.0);
    }

    /// The end of a pass as the position variables.
    fn pass_variables(&mut self, cut: &Cut, depth: f64) -> Done<Axes> {
        let mut end = self.position;
        end.set(0, cut.end);
        end.set(1, cut.crest + cut.inward * depth);
        self.set_targets(&end)?;
        Ok(end)
    }

    /// CanThread: its first lines once, the others at every pass.
    fn canned_passes(&mut self, block: &Block, cut: &Cut) -> Done {
        self.upons(block.vars)?;
        for (i, &depth) in cut.passes.iter().enumerate() {
            self.pass_variables(cut, depth)?;
            self.registers.forget_letters();
            self.shifted = false;
            if i == 0 {
                self.run(block.ops.start..block.repeat, Mode::All)?;
            }
            self.run(block.repeat..block.ops.end, Mode::Hole)?;
        }
        Ok(())
    }

    /// Passes with the code of the `Thread` command.
    fn own_passes(&mut self, cut: &Cut, here: &Axes) -> Done {
        let program = self.program;
        let Some(code) = &program.settings.thread else {
            let help = "add AutoThread, CanThread or the line `Thread G33` to the form";
            return fault(Code::PR008, "the form has no way to thread", help);
        };
        for (i, &depth) in cut.passes.iter().enumerate() {
            let end = self.pass_variables(cut, depth)?;
            if program.settings.thread_full {
                let mut start = *here;
                start.set(1, end.values[1] + cut.taper);
                self.rapid_to(&start)?;
            }
            if i == 0 || program.settings.thread_full {
                self.thread_block(code, &end, cut)?;
            } else {
                self.axis_word(1, &end)?;
                self.end_block();
            }
            self.position = end;
            if program.settings.thread_full {
                self.registers.forget_group(crate::lang::Group::Motion);
                let mut clear = end;
                clear.values[1] = here.values[1];
                self.rapid_to(&clear)?;
                self.rapid_to(here)?;
            }
        }
        Ok(())
    }

    /// Code, radius, length, taper, lead.
    fn thread_block(&mut self, code: &sema::Code, end: &Axes, cut: &Cut) -> Done {
        self.code_word(code)?;
        self.axis_word(1, end)?;
        self.axis_word(0, end)?;
        self.letter_word(b'I', cut.taper)?;
        self.letter_word(self.program.settings.feed_code, cut.lead)?;
        self.end_block();
        Ok(())
    }
}
