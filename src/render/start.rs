//! The beginning and the end of a program.

use super::changes::settable;
use super::codes::Shift;
use super::fault::{Done, fault};
use super::output::Layout;
use super::renderer::Renderer;
use super::words::Mode;
use crate::compile::{Op, Routine};
use crate::cycle::Defaults;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId, work_code};
use crate::sema::{Settings, UnitChoice};
use crate::toolpath::{FeedMode, Start, Units};

/// Millimetres in an inch.
const MM: f64 = 25.4;

/// Defaults before the job has said its units.
pub(super) fn no_defaults() -> Defaults {
    Defaults {
        clear: 0.0,
        step: None,
        min_step: 0.0,
        back_deep: 0.0,
        back_chipbreak: 0.0,
        back_thru: 0.0,
        dwell: 0.0,
        dwell_at_steps: false,
        dwell_at_retracts: false,
        orient: 0.0,
        jog: 0.0,
        sink_clear: None,
        sink_as_printed: false,
        rigid: false,
    }
}

/// What holds where neither cycle nor form says it: in inches and in millimetres.
const CLEAR: [f64; 2] = [0.1, 3.0];
const BACK: [f64; 2] = [0.05, 1.0];
const JOG: [f64; 2] = [0.02, 0.5];

/// What a form gives where a cycle names nothing, in these units.
pub fn cycle_defaults(settings: &Settings, units: Units, sink_as_printed: bool) -> Defaults {
    let scale = factor(units_of(settings).unwrap_or(Units::Inch), units);
    let length = |value: f64| value * scale;
    // what a form for both units says is inches; what it leaves to the default is the job's own
    let own = units_of(settings).unwrap_or(units);
    let or = |said: Option<f64>, default: [f64; 2]| {
        said.map_or_else(|| default[usize::from(own == Units::Mm)] * factor(own, units), length)
    };
    Defaults {
        clear: or(settings.cycle_clear, CLEAR),
        step: settings.cycle_step.map(length),
        min_step: length(settings.cycle_min_step),
        back_deep: or(settings.cycle_back_deep, BACK),
        back_chipbreak: or(settings.cycle_back_chipbreak, BACK),
        back_thru: or(settings.cycle_back_thru, BACK),
        dwell: settings.cycle_dwell,
        dwell_at_steps: settings.cycle_dwell_steps,
        dwell_at_retracts: settings.cycle_dwell_retracts,
        orient: settings.cycle_orient,
        jog: or(settings.cycle_jog, JOG),
        sink_clear: settings.cycle_sink_clear.map(length),
        sink_as_printed,
        rigid: false,
    }
}

/// The one unit that a form is for.
fn units_of(settings: &Settings) -> Option<Units> {
    match settings.units {
        UnitChoice::Inch => Some(Units::Inch),
        UnitChoice::Mm => Some(Units::Mm),
        UnitChoice::Both => None,
    }
}

fn factor(from: Units, to: Units) -> f64 {
    match (from, to) {
        (Units::Inch, Units::Mm) => MM,
        (Units::Mm, Units::Inch) => 1.0 / MM,
        _ => 1.0,
    }
}

impl Renderer<'_> {
    /// Variables that the form's commands give values, and those that the caller set.
    pub(super) fn form_values(&mut self) {
        let settings = &self.program.settings;
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
        let program = self.program;
        let settings = &program.settings;
        if start.machine != settings.machine {
            let message =
                format!("the job is for a {}, the form for a {}", start.machine.name(), settings.machine.name());
            return fault(Code::PR008, message, "take a form for this machine");
        }
        self.choose_units(start.units)?;
        self.letters = &program.letters[usize::from(self.units == Units::Mm)];
        let number = settings.numbers.letter.map_or(self.letters[b'N'].format, |letter| self.letters[letter].format);
        self.layout = Layout::new(settings, number.int.count, number.int.fixed);
        self.tool_order.clone_from(&start.tool_order);
        if let Some(first) = start.tool_order.as_ref().and_then(|order| order.first()) {
            self.vars.set(VarId::Tool1, *first);
        }
        self.vars.put(VarId::Program, self.options.program.map(f64::from).or(start.program));
        self.answers(start)?;
        self.set_defaults();
        for text in &settings.mod_text {
            self.out.word(&self.layout, false).extend_from_slice(text.as_bytes());
            self.end_block();
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

    /// Units of the program, and the factors to them.
    fn choose_units(&mut self, job: Units) -> Done {
        let settings = &self.program.settings;
        self.units = self.options.units.unwrap_or(job);
        let form = units_of(settings);
        if form.is_some_and(|form| form != self.units) && !self.program.printed.has(VarId::Unitmode) {
            let (program, form) = (self.units.name(), form.map_or("", Units::name));
            let message = format!("the program would be in {program}, the form is for {form} and prints no [unitmode]");
            let help = format!(
                "render with `--units {form}`, or print `G[unitmode]` in StartCode: the machine would move 25.4 times as far or as little"
            );
            return fault(Code::PR010, message, help);
        }
        self.scale = factor(job, self.units);
        self.form_scale = factor(form.unwrap_or(Units::Inch), self.units);
        self.vars.set(VarId::Unitmode, settings.inch_mm[usize::from(self.units == Units::Mm)]);
        Ok(())
    }

    /// Values from the job and the caller; every prompt needs an answer.
    fn answers(&mut self, start: &Start) -> Done {
        for (name, value) in &start.set {
            let var = settable(name)?;
            self.set_variable(var, self.in_program_units(var, *value));
        }
        for (var, value) in self.options.set.clone() {
            self.set_variable(var, value);
        }
        for prompt in &self.program.settings.prompts {
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

    /// Cycle defaults in program units.
    fn set_defaults(&mut self) {
        self.defaults = cycle_defaults(&self.program.settings, self.units, self.options.sink_as_printed);
    }

    /// The end of the job: EndCode.
    pub(super) fn finish(&mut self) -> Done {
        self.close_cycle()?;
        self.check_sections_closed()?;
        if self.compensated {
            let message = "cutter compensation is still on at the end of the program";
            self.note(Code::PR023, message.into(), "end it with an `outfeed`");
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
        let Some(routine) = self.program.routine(SequenceId::EndCode) else { return Ok(()) };
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
        let mut lines = routine.ops.clone().rev().filter(|&i| matches!(self.program.ops[i], Op::Line { .. }));
        lines.next().filter(|&line| self.is_percent(line)).unwrap_or(routine.ops.end)
    }

    /// Is the line that begins here a `%`?
    pub(super) fn is_percent(&self, line: usize) -> bool {
        matches!(self.program.ops.get(line + 1), Some(Op::Text { index, .. })
            if self.program.texts[*index as usize].starts_with('%'))
    }

    /// The last line of EndCode that may have a block number: `%` is none.
    pub(super) fn last_line(&self) -> Option<usize> {
        let routine = self.program.routine(SequenceId::EndCode)?;
        let is_line = |i: &usize| matches!(self.program.ops[*i], Op::Line { .. });
        routine.ops.clone().rev().filter(is_line).find(|&line| !self.is_percent(line))
    }
}
