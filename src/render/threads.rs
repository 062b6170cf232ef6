//! Threads on a lathe: the control's cycle, a cycle of one pass each, or passes made here.

use super::codes::Shift;
use super::fault::{Done, fault, fault_at};
use super::renderer::{LastMove, Renderer};
use super::words::Mode;
use crate::compile::{Op, Routine};
use crate::control::Group;
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
    /// How much the crest's radius falls from the start to the end, for each unit of length.
    slope: f64,
}

impl Cut {
    /// Radius at the begin of a pass less radius at its end.
    fn taper(&self, begin: f64) -> f64 {
        self.slope * (begin - self.end).abs()
    }
}

impl Renderer<'_> {
    /// A thread of the path. AutoThread goes before CanThread, both before passes made here.
    pub(super) fn thread(&mut self, thread: &Thread) -> Done {
        let program = self.shape.program;
        self.close_cycle()?;
        if program.settings.machine != Machine::Lathe {
            return fault(Code::PR008, "threads are for lathes", "mill the thread by its moves, or tap it");
        }
        if !self.vars.get(VarId::Direct).is_some_and(|code| code != program.settings.spindle[2]) {
            return fault(Code::PR006, "the spindle does not turn", "give the operation a spindle with a direction");
        }
        if self.compensated {
            let help = "end the compensation with an `outfeed` before";
            return fault(Code::PR006, "a thread under cutter compensation", help);
        }
        if self.vars.get(VarId::Speedtype) == Some(program.settings.speed_type[0]) {
            let message =
                "a thread at constant surface speed: each pass turns otherwise, and begins elsewhere".to_owned();
            self.out.note(Code::PR029, message, "give its operation a spindle with \"mode\": \"rpm\"");
        }
        if program.settings.incremental {
            let help = "thread with a form of positions";
            return fault(Code::PR008, "a thread's words are positions, and the form prints increments", help);
        }
        let cut = self.cut(thread)?;
        if self.position.get(1).is_none() {
            let help = "begin with a rapid to beside the thread, which says how far it is from the axis";
            return fault(Code::PR001, "the radius at which the passes of the thread begin is unknown", help);
        }
        let from = self.target(&thread.from).values[1];
        let beside = self.position.values[1];
        let wrong = [from, cut.crest].iter().any(|crest| (beside - crest) * cut.inward > 1e-9);
        if wrong {
            let (kind, place) = if cut.inward > 0.0 { ("inner", "outside") } else { ("outer", "inside") };
            let message = format!("the tool is {place} the crest of an {kind} thread, at the radius {beside}");
            return fault(Code::PR006, message, "rapid to the other side of the crest first");
        }
        let starts = thread.starts.unwrap_or(1.0);
        let begin = self.target(&thread.from).values[0];
        self.thread_variables(thread, &cut);
        let cycle = program.routine(SequenceId::AutoThread).or(program.routine(SequenceId::CanThread));
        if let Some(routine) = cycle {
            self.thread_says(thread, &cut, routine)?;
        } else if thread.chamfer.is_some_and(|length| length != 0.0) {
            let help = "leave the chamfer out, or give the form an AutoThread that prints [chams]";
            return fault(Code::PR017, "passes made of single moves have no chamfer", help);
        }
        for start in 0..starts as u32 {
            // each start begins one pitch further back
            let back = f64::from(start) * thread.pitch * self.shape.scale;
            let begin = begin + back * if begin >= cut.end { 1.0 } else { -1.0 };
            self.vars.set(VarId::Taper, cut.taper(begin));
            let mut at = self.position;
            at.set(0, begin);
            self.set_targets(&at)?;
            if self.attention {
                self.attend()?;
            }
            self.rapid_to(&at)?;
            let here = self.position;
            match (program.routine(SequenceId::AutoThread), program.routine(SequenceId::CanThread)) {
                (Some(routine), _) => {
                    self.pass_variables(&cut, cut.passes[cut.passes.len() - 1])?;
                    self.run_with_upons(routine)?;
                }
                (None, Some(routine)) => self.canned_passes(routine, &cut)?,
                (None, None) => self.own_passes(&cut, &here)?,
            }
            if cycle.is_some_and(|routine| routine.cancel)
                && let Some(cancel) = program.routine(SequenceId::Cancel)
            {
                self.run_with_upons(cancel)?; // else the rapid behind it would be a pass
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
        let Some(begin) = from.get(0).filter(|&begin| begin != end) else {
            return fault(Code::PR006, "the thread has no length", "give `from` and `to` different z");
        };
        let taper = thread.taper.map(|taper| taper * self.shape.scale);
        let crest = if thread.to.given & 0b10 != 0 { to.values[1] } else { start - taper.unwrap_or(0.0) };
        let falls = start - crest;
        if let Some(taper) = taper.filter(|taper| (taper - falls).abs() > 1e-9) {
            let message = format!("the thread's ends differ by {falls} in radius, its `taper` is {taper}");
            return fault(Code::PR006, message, "give x of `to`, or `taper`, or both alike");
        }
        let depth = thread.depth.abs() * self.shape.scale;
        let first = thread.first_depth.map(|d| d * self.shape.scale);
        let least = thread.min_depth.unwrap_or(0.0) * self.shape.scale;
        let passes = thread_passes(depth, first, thread.passes.map(|n| n as usize), least)?;
        Ok(Cut {
            end,
            crest,
            inward: if thread.depth < 0.0 { 1.0 } else { -1.0 },
            passes,
            lead: thread.pitch * thread.starts.unwrap_or(1.0) * self.shape.scale,
            slope: falls / (begin - end).abs() * self.shape.scales[1].signum(),
        })
    }

    fn thread_variables(&mut self, thread: &Thread, cut: &Cut) {
        let first = cut.passes[0];
        let depth = thread.depth.abs() * self.shape.scale;
        let angle = thread.angle.unwrap_or(60.0);
        self.vars.set(VarId::Pitch, thread.pitch * self.shape.scale);
        self.vars.set(VarId::Frate, cut.lead);
        self.vars.set(VarId::Depth, depth);
        self.vars.set(VarId::Peck1, first);
        self.vars.set(VarId::Vbite, thread.min_depth.unwrap_or(0.0) * self.shape.scale);
        self.vars.set(VarId::Vleave, 0.0);
        self.vars.set(VarId::Passes, thread.passes.unwrap_or(cut.passes.len() as f64));
        self.vars.set(VarId::Chams, thread.chamfer.unwrap_or(0.0));
        self.vars.set(VarId::Tipang, angle);
        self.vars.set(VarId::Startang, angle / 2.0);
    }

    /// What the thread asks for must be in the cycle's words, or stand in its packed parameters.
    fn thread_says(&self, thread: &Thread, cut: &Cut, routine: &Routine) -> Done {
        let packed = self.packed_parameters(routine);
        let in_packed = |digits: std::ops::Range<usize>, value: f64| {
            packed.as_deref().and_then(|text| text.get(digits)?.parse().ok()) == Some(value)
        };
        let prints = |vars: &[VarId]| vars.iter().any(|&var| routine.vars.has(var));
        let starts = thread.starts.unwrap_or(1.0);
        let auto = self.shape.program.routine(SequenceId::AutoThread).is_some();
        let missing = [
            (cut.slope != 0.0 && !prints(&[VarId::Taper]), "the taper: [taper]"),
            (starts > 1.0 && !prints(&[VarId::Frate]), "the lead of several starts: [frate]"),
            (!prints(&[VarId::Frate, VarId::Pitch]), "the lead: [frate]"),
            (auto && thread.min_depth.is_some() && !prints(&[VarId::Vbite]), "the least cut: [vbite]"),
            (
                auto && thread.first_depth.is_some() && !prints(&[VarId::Peck1, VarId::Inidep, VarId::Passes]),
                "the first cut: [peck1]",
            ),
            (
                thread.angle.is_some_and(|angle| !in_packed(4..6, angle)) && !prints(&[VarId::Tipang, VarId::Startang]),
                "the angle of the tip: [tipang]",
            ),
            (
                thread.chamfer.is_some_and(|length| !in_packed(2..4, length)) && !prints(&[VarId::Chams]),
                "the chamfer: [chams]",
            ),
        ];
        match missing.iter().find(|(lost, _)| *lost) {
            None => Ok(()),
            Some((_, what)) => {
                let message = format!("the thread cycle does not print {what}");
                let help = "add the word, or say it in the packed parameters: `--set tparams=010029` is 1 finishing pass, no chamfer, 29 degrees";
                fault_at(Code::PR017, message, help, Some(routine.span))
            }
        }
    }

    /// The digits of a packed `[tparams]` word: finishing passes, chamfer, angle, two each.
    fn packed_parameters(&self, routine: &Routine) -> Option<String> {
        let letter = routine.ops.clone().find_map(|i| match self.shape.program.ops[i] {
            Op::Var { letter, var: VarId::Tparams, .. } => Some(letter),
            _ => None,
        })?;
        match self.vars.get(VarId::Tparams) {
            Some(set) => Some(format!("{set:06}")),
            None => {
                self.shape.letters.packed.iter().find(|(packed, _)| *packed == letter).map(|(_, digits)| digits.clone())
            }
        }
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
    fn canned_passes(&mut self, routine: &Routine, cut: &Cut) -> Done {
        self.upons(routine.vars)?;
        for (i, &depth) in cut.passes.iter().enumerate() {
            self.pass_variables(cut, depth)?;
            self.registers.forget_letters();
            self.shifted = Shift::None;
            if i == 0 {
                self.run(routine.ops.start..routine.repeat, Mode::All)?;
            }
            self.run(routine.repeat..routine.ops.end, Mode::Hole)?;
        }
        Ok(())
    }

    /// Passes with the code of the `Thread` command.
    fn own_passes(&mut self, cut: &Cut, here: &Axes) -> Done {
        let program = self.shape.program;
        let Some(code) = &program.settings.thread else {
            let help = "add AutoThread, CanThread or the line `Thread G33` to the form";
            return fault(Code::PR008, "the form has no way to thread", help);
        };
        for (i, &depth) in cut.passes.iter().enumerate() {
            let end = self.pass_variables(cut, depth)?;
            if program.settings.thread_full {
                let mut start = *here;
                start.set(1, end.values[1] + cut.taper(here.values[0]) * self.shape.scales[1].signum());
                self.rapid_to(&start)?;
            }
            if i == 0 || program.settings.thread_full {
                self.thread_block(code, here, &end, cut)?;
            } else {
                self.axis_word(1, &end)?;
                self.out.end_block();
            }
            self.position = end;
            if program.settings.thread_full {
                self.registers.forget_group(Group::Motion);
                let mut clear = end;
                clear.values[1] = here.values[1];
                self.rapid_to(&clear)?;
                self.rapid_to(here)?;
            }
        }
        Ok(())
    }

    /// Code, radius, length, taper, lead.
    fn thread_block(&mut self, code: &sema::Code, here: &Axes, end: &Axes, cut: &Cut) -> Done {
        self.code_word(code)?;
        self.axis_word(1, end)?;
        self.axis_word(0, end)?;
        self.letter_word(b'I', cut.taper(here.values[0]))?;
        self.letter_word(self.shape.program.settings.feed_code, cut.lead)?;
        self.out.end_block();
        Ok(())
    }
}
