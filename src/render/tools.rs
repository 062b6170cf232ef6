//! Operations: tool changes, and what a new operation with the same tool changes.

use super::changes::settable;
use super::fault::{Done, fault, fault_at};
use super::renderer::{LastMove, Renderer};
use crate::control::Group;
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId, VarSet};
use crate::toolpath::{Axes, Coolant, FeedMode, First, Tool, ToolChange};

/// The position variables of a tool change.
const POSITION: VarSet = VarSet::of(&[VarId::H, VarId::V, VarId::D]);

impl Renderer<'_> {
    /// An operation begins.
    pub(super) fn tool_change(&mut self, change: &ToolChange) -> Done {
        self.close_cycle()?;
        self.check_sections_closed()?;
        self.begin_main()?;
        let number = change.tool.as_ref().map(|tool| tool.number);
        let changes = number.is_some() && number != self.tool;
        if number.is_none() && self.tool.is_none() && self.shape.program.settings.machine != Machine::Edm {
            let help = "load a tool before the first motion, or give a CL file one with `--assume-tool`";
            return fault(Code::PJ006, "the operation has no tool", help);
        }
        self.conditions(change, changes)?;
        if let Some(comment) = &change.comment {
            self.comment_block(comment);
        }
        match &change.tool {
            Some(tool) if changes => self.change_tool(tool, &change.first)?,
            Some(tool) => self.same_registers(tool)?,
            None => {}
        }
        Ok(())
    }

    /// The tool that is in keeps its offset registers: no sequence would print others.
    fn same_registers(&self, tool: &Tool) -> Done {
        let registers =
            [(VarId::Lcomp, tool.length_offset, "length"), (VarId::Dcomp, tool.diameter_offset, "diameter")];
        for (var, register, name) in registers {
            if register.is_some() && register != self.vars.get(var) {
                let message = format!("tool {} is in, and its {name} offset register changes", tool.number);
                return fault(Code::PR017, message, "give it a number of its own, or keep the register");
            }
        }
        Ok(())
    }

    /// Spindle, coolant, work offset and feeds of the operation.
    fn conditions(&mut self, change: &ToolChange, new_tool: bool) -> Done {
        if new_tool {
            for var in [VarId::Speed, VarId::Direct] {
                self.vars.put(var, None);
            }
            self.vars.put(VarId::Maxrpm, self.most_rpm);
            self.vars.set(VarId::Speedtype, self.shape.program.settings.speed_type[1]);
        }
        if change.spindle.is_some_and(|spindle| spindle.speed.is_some() && spindle.css.is_none()) {
            self.vars.set(VarId::Speedtype, self.shape.program.settings.speed_type[1]); // revolutions, unless it says otherwise
        }
        if let Some(spindle) = &change.spindle {
            self.set_spindle(spindle)?;
        }
        match change.coolant {
            Some(coolant) => self.set_coolant(coolant),
            None if new_tool => self.set_coolant(Coolant::Off),
            None => {}
        }
        if let Some(work) = change.work {
            self.set_work(work)?;
        }
        if let (Some(tool), Machine::Lathe) = (&change.tool, self.shape.program.settings.machine) {
            self.vars.set(VarId::Comp, self.turret_word(tool)?);
        }
        for (name, value) in &change.set {
            let var = settable(name)?;
            self.set_variable(var, self.in_program_units(var, *value));
        }
        self.set_feed_mode(change.feed_mode.unwrap_or(FeedMode::PerMinute));
        self.keep_feed(None);
        if let Some(feed) = change.feed {
            self.set_feed(feed);
        }
        let plunge = change.plunge.or(change.feed).map(|feed| feed * self.shape.scale);
        self.vars.put(VarId::Plunge, plunge);
        self.attention = true;
        Ok(())
    }

    fn change_tool(&mut self, tool: &Tool, first: &First) -> Done {
        let program = self.shape.program;
        if self.compensated {
            let help = "end the compensation with an `outfeed` before";
            return fault(Code::PR006, "the tool changes under cutter compensation", help);
        }
        let is_first = self.tool.is_none();
        self.tool_variables(tool)?;
        self.tool = Some(tool.number);
        self.fresh_tool = true;
        self.tool_changes += 1;
        let id = if is_first { SequenceId::FirstToolChange } else { SequenceId::ToolChange };
        let routine = program.routine(id);
        let first_target = match first {
            First::Rapid(to) => Some((self.target(to), to.given)),
            First::Hole(spec, hole) => Some((self.hole_position(spec, hole)?, hole.at.given | self.shape.depth_bit())),
            First::Cut | First::Nothing => None,
        };
        let target = match (first_target, routine) {
            (Some((target, given)), Some(routine)) => Some(self.change_turns(routine, &target, given)?),
            _ => None,
        };
        // another tool has no last position that a first rapid could keep; the part stays turned as it is
        self.angles.keep(&self.position);
        self.position = Axes::default();
        self.left_at = None;
        for var in [VarId::H, VarId::V, VarId::D] {
            self.vars.put(var, None);
        }
        self.registers.forget_all();
        self.served.speed = None;
        self.served.direct = None;
        self.served.max = None;
        let Some(routine) = routine else { return Ok(()) };
        match &target {
            Some(target) => self.set_targets(target)?,
            None if routine.vars.meets(POSITION) => {
                let at = program.spans[routine.ops.clone()].first().copied();
                let help = "begin the operation with a rapid to above its first cut";
                return match first {
                    First::Cut => {
                        let message = "the operation begins with a cut, and the tool change would rapid to its end";
                        fault_at(Code::PR012, message, help, at)
                    }
                    _ => fault_at(Code::PR012, "the operation has no move for the tool change to print", help, at),
                };
            }
            None => {}
        }
        if routine.vars.meets(POSITION) && !routine.vars.has(VarId::Work) {
            self.work_before()?; // the position counts from it
        }
        if routine.vars.has(VarId::Speed) && !routine.vars.has(VarId::Speedtype) {
            self.speed_mode_before()?; // else a surface speed would be revolutions
        }
        self.check_distance_of(routine)?;
        self.placed = 0;
        self.moved_by = None;
        self.upons_of_change(routine);
        self.run_with_upons(routine)?;
        if let Some(target) = target {
            self.move_to(&Axes { given: target.given & self.placed, ..target });
        }
        self.registers.forget_group(Group::Motion);
        self.last_move = LastMove::None;
        if program.settings.restart_depth {
            self.registers.forget(self.shape.letters[self.shape.axes[self.shape.depth]].printed);
        }
        self.force();
        Ok(())
    }

    /// `[comp]`, the T word of a lathe: station and offset register in two digits each. A job's number that holds both
    /// stays as it is.
    fn turret_word(&self, tool: &Tool) -> Done<f64> {
        const STATIONS: f64 = 100.0;
        let whole = tool.number >= STATIONS;
        let register = match tool.length_offset {
            None if whole => return Ok(tool.number),
            own => own.unwrap_or(tool.number + self.shape.program.settings.lcomp),
        };
        let other = whole && register != tool.number % STATIONS && register != tool.number;
        if self.shape.program.printed.has(VarId::Comp) && (other || !whole && register >= STATIONS) {
            let message =
                format!("tool {} with the offset register {register} has no T word of two and two digits", tool.number);
            let help = "give it a register below 100, and a number from 100 on only if it holds the register";
            return fault(Code::PR017, message, help);
        }
        Ok(if whole { tool.number } else { tool.number * STATIONS + register })
    }

    fn tool_variables(&mut self, tool: &Tool) -> Done {
        let settings = &self.shape.program.settings;
        self.vars.put(VarId::Lasttool, self.tool);
        if self.tool.is_none() {
            self.vars.set(VarId::Tool1, tool.number);
        }
        self.vars.set(VarId::Tool, tool.number);
        self.vars.put(VarId::Toold, tool.diameter.map(|d| d * self.shape.scale));
        self.vars.set(VarId::Lcomp, tool.length_offset.unwrap_or(tool.number + settings.lcomp));
        self.vars.set(VarId::Dcomp, tool.diameter_offset.unwrap_or(tool.number + settings.dcomp));
        self.vars.put(VarId::Turret, tool.turret);
        self.shape.choose_turret(tool.turret);
        if let Some(order) = &self.tool_order {
            if order.get(self.tool_changes) != Some(&tool.number) {
                let message = format!("tool {} comes next, `tool_order` says otherwise", tool.number);
                return fault(Code::PJ005, message, "list the tools in the order of their use");
            }
            let next = order.get(self.tool_changes + 1).or_else(|| order.first()).copied();
            self.vars.put(VarId::Nexttool, next);
        }
        Ok(())
    }
}
