//! The beginning and the end of a program.

use super::changes::settable;
use super::codes::Shift;
use super::fault::{Done, fault};
use super::renderer::Renderer;
use super::words::Mode;
use crate::compile::{Op, Routine};
use crate::diag::Code;
use crate::lang::{SequenceId, VarId, work_code};
use crate::toolpath::{FeedMode, Start, Units};

impl Renderer<'_> {
    /// Variables that the form's commands give values, and those that the caller set.
    pub(super) fn form_values(&mut self) {
        let settings = &self.shape.program.settings;
        self.vars.set(VarId::Incmode, settings.inc_abs[usize::from(!settings.incremental)]);
        self.vars.set(VarId::Coolantoff, settings.coolant[1]);
        self.vars.set(VarId::Flush, settings.flush[1]);
        self.vars.set(VarId::Speedtype, settings.speed_type[1]);
        // a form that counts its offsets from 1 counts the default code so too
        let default = settings.work_default;
        let work = if default < 50.0 { default } else { work_code(settings.work, default).unwrap_or(default) };
        self.vars.set(VarId::Work, work);
        self.vars.set(VarId::Cool, settings.coolant[1]);
        self.vars.set(VarId::Lasthole, 0.0);
        self.served.work = Some(work);
        self.served.cool = Some(settings.coolant[1]);
        self.served.speed_type = Some(settings.speed_type[1]);
        self.set_feed_mode(FeedMode::PerMinute);
        self.served.feed_type = self.vars.get(VarId::Feedtype);
    }

    /// The job's head: units, checks, Mod text, StartCode.
    pub(super) fn start(&mut self, start: &Start) -> Done {
        let program = self.shape.program;
        let settings = &program.settings;
        if start.machine != settings.machine {
            let message =
                format!("the job is for a {}, the form for a {}", start.machine.name(), settings.machine.name());
            return fault(Code::PR008, message, "take a form for this machine");
        }
        self.shape.choose_units(start.units)?;
        self.vars.set(VarId::Unitmode, settings.inch_mm[usize::from(self.shape.units == Units::Mm)]);
        self.out.set_letters(settings, self.shape.letters);
        self.tool_order.clone_from(&start.tool_order);
        if let Some(first) = start.tool_order.as_ref().and_then(|order| order.first()) {
            self.vars.set(VarId::Tool1, *first);
        }
        self.vars.put(VarId::Program, self.shape.options.program.map(f64::from).or(start.program));
        self.answers(start)?;
        for text in &settings.mod_text {
            self.out.text(text, false);
            self.out.end_block();
        }
        if let Some(routine) = program.routine(SequenceId::StartCode) {
            self.upons(routine.vars)?;
            self.shifted = Shift::None;
            // with subprograms first only the leading `%` comes now
            let now = if settings.subs_first { self.start_code_rest() } else { routine.ops.end };
            self.run(routine.ops.start..now, Mode::All)?;
            self.subs.start_waits = settings.subs_first;
        }
        Ok(())
    }

    /// Values from the job and the caller; every prompt needs an answer.
    fn answers(&mut self, start: &Start) -> Done {
        for (name, value) in &start.set {
            let var = settable(name)?;
            self.set_variable(var, self.in_program_units(var, *value));
        }
        for (var, value) in self.shape.options.set.clone() {
            self.set_variable(var, value);
        }
        for prompt in &self.shape.program.settings.prompts {
            if self.vars.get(prompt.var).is_some() {
                continue;
            }
            let Some(default) = prompt.default else {
                let name = prompt.var.name();
                let diag = crate::diag::Diag::new(Code::PR015, format!("[{name}] is asked for: {}", prompt.text))
                    .at(prompt.span, "asked for here")
                    .help(format!("answer with `--set {name}=VALUE`"));
                return Err(Box::new(diag));
            };
            self.vars.set(prompt.var, default);
        }
        self.most_rpm = self.vars.get(VarId::Maxrpm);
        Ok(())
    }

    /// The end of the job: EndCode.
    pub(super) fn finish(&mut self) -> Done {
        self.close_cycle()?;
        self.check_sections_closed()?;
        if self.compensated {
            let message = "cutter compensation is still on at the end of the program";
            self.out.note(Code::PR023, message.into(), "end it with an `outfeed`");
        }
        if let Some(order) = &self.tool_order
            && self.tool_changes != order.len()
        {
            let message = format!("`tool_order` lists {} tools, the job used {}", order.len(), self.tool_changes);
            return fault(Code::PJ005, message, "list the tools in the order of their use, each change once");
        }
        self.begin_main()?;
        self.check_calls()?;
        self.set_here()?;
        let Some(routine) = self.shape.program.routine(SequenceId::EndCode) else { return Ok(()) };
        self.check_distance_of(routine)?;
        if !self.has_waiting() {
            return self.run_with_upons(routine);
        }
        // subprograms stand after the main program, before the `%` that ends the tape
        let percent = self.closing_percent(routine);
        self.upons(routine.vars)?;
        self.shifted = Shift::None;
        self.run(routine.ops.start..percent, Mode::All)?;
        self.append_waiting();
        self.run(percent..routine.ops.end, Mode::All)
    }

    /// Where the `%` at the end of EndCode begins; its end, when there is none.
    fn closing_percent(&self, routine: &Routine) -> usize {
        let mut lines = routine.ops.clone().rev().filter(|&i| matches!(self.shape.program.ops[i], Op::Line { .. }));
        lines.next().filter(|&line| self.is_percent(line)).unwrap_or(routine.ops.end)
    }

    /// Is the line that begins here a `%`?
    pub(super) fn is_percent(&self, line: usize) -> bool {
        matches!(self.shape.program.ops.get(line + 1), Some(Op::Text { index, .. })
            if self.shape.program.texts[*index as usize].starts_with('%'))
    }

    /// The last line of EndCode that may have a block number: `%` is none.
    pub(super) fn last_line(&self) -> Option<usize> {
        let routine = self.shape.program.routine(SequenceId::EndCode)?;
        let is_line = |i: &usize| matches!(self.shape.program.ops[*i], Op::Line { .. });
        routine.ops.clone().rev().filter(is_line).find(|&line| !self.is_percent(line))
    }
}
