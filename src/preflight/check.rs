//! Checks the actions of a program against its machine.

use std::collections::{BTreeMap, HashSet};

use super::clock::Clock;
use super::fit::Fit;
use super::fitted::{Fitted, Known};
use super::place::{At, Base, Going, Places};
use super::travel::Travels;
use crate::control::{Control, Meaning};
use crate::diag::Code;
use crate::machine::{LETTERS, Machine, Sweep, offsets};
use crate::nc::{Action, FIRST_NAMED_TOOL, Item, Pace, Simulator};
use crate::toolpath::Coolant;
use crate::verify::Finding;

/// The state of the check while a program runs.
pub(super) struct Check<'m> {
    pub(super) machine: &'m Machine,
    pub(super) control: &'static Control,
    known: &'m Known,
    places: Places<'m>,
    travels: Travels<'m>,
    tool: Option<u32>,
    tools: HashSet<u32>,
    pub(super) pace: Pace,
    clock: Result<Clock, String>,
    /// The findings by code and subject. Several findings about one subject are joined to one finding.
    found: BTreeMap<(Code, String), Finding>,
    /// For each reference point (of G28, of G30, and of G30 with another P): whether the program moved to the point
    /// although the machine's file does not contain the position.
    no_reference: [bool; 3],
    was_compensated: bool,
    /// Whether the program moved to a machine position whose zero only the machine has.
    hides_zero: bool,
    /// Whether the program moved to a machine position in which the tool length may count.
    hides_length: bool,
    /// As bits, the axes that are at a machine position from the program after the last block.
    said: u8,
}

impl<'m> Check<'m> {
    pub fn new(machine: &'m Machine, control: &'static Control, known: &'m Known) -> Check<'m> {
        Check {
            machine,
            control,
            known,
            places: Places::new(machine, control.is_lathe()),
            travels: Travels::new(machine),
            tool: None,
            tools: HashSet::new(),
            pace: Pace::new(machine.speeds.map_or(f64::INFINITY, |[_, fastest]| fastest)),
            clock: Clock::of(machine),
            found: BTreeMap::new(),
            no_reference: [false; 3],
            was_compensated: false,
            hides_zero: false,
            hides_length: false,
            said: 0,
        }
    }

    /// Turns on the recording of the time of each block.
    pub fn keep_blocks(&mut self) {
        if let Ok(clock) = &mut self.clock {
            clock.keep_blocks();
        }
    }

    /// Checks the actions of a block.
    pub fn block(&mut self, items: &[Item], run: &Simulator<'_>) {
        let before = std::mem::replace(&mut self.said, run.state().at_said_machine());
        let is_move = |item: &Item| matches!(item.action, Action::Rapid { .. } | Action::Feed { .. } | Action::Arc(_));
        let last = items.iter().rposition(is_move);
        let reference =
            run.reference_point().filter(|point| self.machine.references.get(*point).is_none_or(Option::is_none));
        for (at, item) in items.iter().enumerate() {
            // the machine positions in a block belong to the last move of the block
            let is_last = last == Some(at);
            let said = if is_last { self.said } else { before & self.said };
            // the machine's file does not contain this reference point, so its position is unknown
            let hidden = match reference {
                Some(point) if is_last => {
                    // G30 P3 and G30 P4 are reported together
                    self.no_reference[point.min(2)] = true;
                    0x3f
                }
                _ if is_last => self.hidden(run),
                _ => 0,
            };
            self.item(item, [said, hidden], run);
        }
    }

    /// As bits, the axes whose machine position in the last block depends on data that only the machine has.
    fn hidden(&mut self, run: &Simulator<'_>) -> u8 {
        if run.goes_hidden() {
            self.hides_zero = true;
            return 0x3f;
        }
        let has_length = self.places.register.is_some_and(|register| register != 0);
        let by_length = has_length && run.may_keep_length();
        self.hides_length |= by_length;
        if by_length { 1 << run.state().length_axis() } else { 0 }
    }

    fn item(&mut self, item: &Item, [said, hidden]: [u8; 2], run: &Simulator<'_>) {
        let line = (item.line, run.text());
        if let Ok(clock) = &mut self.clock {
            clock.at_line(item.line);
        }
        let before = self.places.at;
        let going = |in_machine: u8, hidden: u8| Going {
            in_machine,
            said,
            hidden,
            says: run.says_positions(),
            all_said: item.by_cycle && run.is_absolute(),
        };
        self.pace.takes(&item.action);
        match &item.action {
            Action::Rapid { to, machine, .. } => {
                self.places.goes(to, going(*machine, hidden & machine), run);
                self.clocks(|clock, after| clock.rapid(&before, after));
                self.travels.moved(&self.places, None, self.tool, line);
                self.fixtures(&before, line);
            }
            Action::Feed { to, feed, lead, machine, .. } => {
                let from = self.places.program(run);
                self.places.goes(to, going(*machine, 0), run);
                self.travels.moved(&self.places, None, self.tool, line);
                let feed = self.straight_feed(&from, to, (*feed, *lead), run, line);
                self.clocks(|clock, after| clock.cut(&before, after, feed));
            }
            Action::Arc(turn) => {
                let from = self.places.program(run);
                self.places.goes(&turn.to, going(turn.machine, 0), run);
                let ranges = self.places.extremes(&from, turn, run);
                self.travels.moved(&self.places, Some(ranges), self.tool, line);
                let (curve, feed) = self.arc_feed(&from, turn, run, line);
                self.clocks(|clock, after| clock.arc(curve, &before, after, feed));
            }
            Action::Tool(number) => {
                self.changes_tool(*number, run, line);
                let tool = self.tool;
                self.places.changes_tool();
                self.clocks(|clock, _| clock.change(tool));
            }
            Action::Dwell(seconds) => self.clocks(|clock, _| clock.dwell(*seconds)),
            Action::Stop(_) | Action::Orient(_) => self.clocks(|clock, _| clock.stop()),
            Action::LeftOut(_, Meaning::ExactStop) => self.clocks(|clock, _| clock.stop()),
            Action::LeftOut(code, Meaning::Path) => {
                let tolerance = run.path_tolerance().map(|tolerance| tolerance * run.state().units().in_mm());
                self.clocks(|clock, _| clock.follows(*code, tolerance));
            }
            Action::Length(register) => {
                self.places.adds = register.is_some() && (self.places.adds || run.adds_length());
                self.takes_length(*register, line);
            }
            Action::LeftOut(code, Meaning::SetOffsets) => {
                if let Some(register) = run.set_length() {
                    self.places.sets_length(register);
                    let message = format!("{code} sets the length H{register}, so the length of the table is not used");
                    let help = "use the interval that is printed, or remove G10 and set the length in the table";
                    self.found(Code::PM015, &format!("H{register}"), message, help, line);
                }
            }
            Action::Work(_) => self.takes_offset(run, line),
            Action::Frame if run.presets() => self.places.reframed(),
            Action::Compensation(side) => self.was_compensated |= side.is_some(),
            Action::Coolant(kind) => {
                self.cools(*kind, line);
                self.clocks(|clock, _| clock.stop());
            }
            // the control's file gives no meaning to this code, but the form may use it for a kind of coolant
            Action::LeftOut(code, _) => {
                if let Some((_, kind)) = self.known.coolant.iter().find(|(own, _)| own == code) {
                    self.cools(*kind, line);
                }
            }
            Action::SpeedLimit(limit) => self.turns(*limit, "the speed limit", line),
            Action::Spindle(rotation, speed) => {
                let speed = self.pace.switched(*rotation, *speed);
                self.turns(speed, "the spindle's speed", line);
                self.clocks(|clock, _| clock.spindle(*rotation, speed));
            }
            _ => {}
        }
    }

    fn fixtures(&mut self, before: &[At; 6], (line, block): (u64, &[u8])) {
        for fixture in &self.machine.fixtures {
            let (Some(from), Some(to)) =
                (self.in_fixture(before, fixture.work), self.in_fixture(&self.places.at, fixture.work))
            else {
                continue;
            };
            let entry = self.tool.and_then(|tool| self.machine.tools.as_ref()?.0.get(&tool));
            let of_job = self.tool.and_then(|tool| self.known.tools.iter().find(|own| own.number == tool)?.diameter);
            let diameter = entry.and_then(|entry| entry.diameter).or(of_job).unwrap_or(0.0);
            let length = entry.and_then(|entry| entry.length).unwrap_or(f64::INFINITY);
            if fixture.is_entered(&Sweep { from, to, radius: diameter / 2.0, length }) {
                let name = fixture
                    .name
                    .clone()
                    .unwrap_or_else(|| format!("a fixture in {}", offsets::name(self.control, fixture.work)));
                let tool = self.tool.map_or("the tool".to_owned(), |tool| format!("T{tool}"));
                let message = format!("{tool} goes through {name} at rapid");
                let help = "retract the tool above it, or move around it";
                self.found(Code::PM002, &format!("{name} {line}"), message, help, (line, block));
            }
        }
    }

    /// Position of the tip in a work offset, in millimetres. `None`: the position is unknown, or it is relative to another offset.
    fn in_fixture(&self, at: &[At; 6], work: usize) -> Option<[f64; 3]> {
        let mut tip = [0.0; 3];
        for (axis, value) in tip.iter_mut().enumerate() {
            let known = self.machine.offset(work).and_then(|offset| offset[axis]);
            let (base, length) = match at[axis].base {
                Base::Unknown => return None,
                Base::Machine => (known?, self.spindle_to_tip(axis)?),
                Base::Work(needs) if needs.work == work && needs.offset_unknown => (0.0, self.added(needs.register)),
                Base::Work(needs) if needs.offset_unknown => return None,
                Base::Work(needs) => (known?, self.added(needs.register)),
            };
            *value = at[axis].value - base - length;
        }
        Some(tip)
    }

    /// Distance along an axis from the gauge line to the tip of the tool. Machine coordinates are the coordinates of
    /// the gauge line.
    fn spindle_to_tip(&self, axis: usize) -> Option<f64> {
        if axis != 2 {
            return Some(0.0);
        }
        self.places.length(i32::try_from(self.tool?).ok()?)
    }

    /// The tool length that is included in a position.
    fn added(&self, register: Option<i32>) -> f64 {
        register.and_then(|register| self.places.length(register)).unwrap_or(0.0)
    }

    /// Calls `count` with the clock and the current positions of the axes, if there is a clock.
    fn clocks(&mut self, count: impl FnOnce(&mut Clock, &[At; 6])) {
        if let Ok(clock) = &mut self.clock {
            count(clock, &self.places.at);
        }
    }

    fn turns(&mut self, speed: f64, what: &str, line: (u64, &[u8])) {
        let Some([least, most]) = self.machine.speeds else { return };
        if speed > 0.0 && !(least..=most).contains(&speed) {
            let message = format!("{what} is S{speed}, but the range of the machine is {least} to {most}");
            let help = "the control uses its own limit, or stops with an alarm: write a speed in the range";
            self.found(Code::PM010, &format!("speed {speed}"), message, help, line);
        }
    }

    fn changes_tool(&mut self, number: f64, run: &Simulator<'_>, line: (u64, &[u8])) {
        let name = run.state().tool_name(number);
        let number = number as u32;
        self.tool = Some(number).filter(|number| *number != 0 && name.is_none());
        if number == 0 || !self.tools.insert(number) {
            return;
        }
        if let Some(table) = &self.machine.tools {
            let of_job = self.known.tools.iter().find(|tool| tool.number == number).and_then(|tool| tool.diameter);
            match table.0.get(&number) {
                None => {
                    let (tool, help) = match name {
                        Some(name) => (format!("tool \"{name}\""), "add the name to the tool in the table"),
                        None => (format!("T{number}"), "add the tool to the table, with its length and diameter"),
                    };
                    let message = format!("the machine's table has no {tool}");
                    self.found(Code::PM011, &tool, message, help, line);
                }
                Some(entry) => {
                    if let (Some(own), Some(job)) = (entry.diameter, of_job)
                        && (own - job).abs() > 1e-3
                    {
                        let (own, job) = (self.machine.shown(own), self.machine.shown(job));
                        let message =
                            format!("the diameter of T{number} is {own} in the machine's table, but {job} in the job");
                        let help = "load the tool of the job, or change the table";
                        self.found(Code::PM011, &format!("T{number}"), message, help, line);
                    }
                }
            }
        }
        if let Some(places) = self.machine.places
            && self.tools.len() as u32 > places
        {
            let message = format!("the program uses more tools than the magazine has places: {places}");
            self.found(Code::PM012, "", message, "split the program, or load tools by hand", line);
        }
    }

    fn takes_length(&mut self, register: Option<f64>, line: (u64, &[u8])) {
        self.places.takes_length(register);
        // the second edge of tool 5 has the register 5.01
        if let Some(register) = register.filter(|register| register.fract() != 0.0) {
            let edge = (register.fract() * 100.0).round() + 1.0;
            let message = format!("the machine's table has no length of edge D{edge}");
            let help = "the length of edge D2 and the following ones is not checked: use D1, or check it yourself";
            self.found(Code::PM015, &format!("D{register}"), message, help, line);
            return;
        }
        let (Some(register), Some(table)) =
            (self.places.register.filter(|register| *register != 0), &self.machine.tools)
        else {
            return;
        };
        let number = register.unsigned_abs();
        // a tool that is missing in the table already has a finding
        let is_said =
            (self.tool == Some(number) || f64::from(number) >= FIRST_NAMED_TOOL) && !table.0.contains_key(&number);
        let known = table.0.get(&number).is_some_and(|entry| entry.length.is_some());
        if !known && !is_said && !self.control.is_lathe() {
            let message = format!("the machine's table has no length H{number}");
            let help = "measure the tool and add its length to the table";
            self.found(Code::PM015, &format!("H{number}"), message, help, line);
        }
    }

    fn takes_offset(&mut self, run: &Simulator<'_>, line: (u64, &[u8])) {
        let Some(offsets) = &self.machine.offsets else { return };
        let number = run.state().work_number();
        if !offsets.contains_key(&number) && run.state().offset_given() == 0 {
            let name = offsets::name(self.control, number);
            let message = format!("the machine's file does not contain {name}");
            let help = "add the offset under [offsets], or use the interval that is printed";
            self.found(Code::PM015, &name, message, help, line);
        }
    }

    fn cools(&mut self, kind: Coolant, line: (u64, &[u8])) {
        let Some(kinds) = &self.machine.coolant else { return };
        if kind != Coolant::OFF && !kinds.contains(&kind) {
            let name = kind.name();
            let listed: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
            let listed = if listed.is_empty() { "none".to_owned() } else { format!("only {}", listed.join(", ")) };
            let message = format!("the program turns on the coolant `{name}`, but the machine's file lists {listed}");
            let help = "if the machine has this kind, add it to `kinds` under [coolant] in the machine's file; otherwise \
                        give another kind of coolant in the job";
            self.found(Code::PM013, name, message, help, line);
        }
    }

    /// Checks whether the control can store the program.
    pub fn memory(&mut self, bytes: u64, program: Option<f64>) {
        if let Some(most) = self.machine.bytes.filter(|most| bytes > *most) {
            let message = format!("the program has {bytes} bytes, but the control stores only {most}");
            self.found(Code::PM014, "bytes", message, "drip-feed the program from outside, or split it", (0, b""));
        }
        if let (Some([least, most]), Some(number)) = (self.machine.numbers, program)
            && !(f64::from(least)..=f64::from(most)).contains(&number)
        {
            let message = format!("the program number is {number}, but the control takes only {least} to {most}");
            self.found(Code::PM014, "number", message, "give the program another number: `--program`", (0, b""));
        }
    }

    pub(super) fn found(
        &mut self,
        code: Code,
        about: &str,
        message: String,
        help: &'static str,
        (line, block): (u64, &[u8]),
    ) {
        let finding = self.found.entry((code, about.to_owned())).or_insert_with(|| Finding {
            code,
            message,
            help,
            place: None,
            line,
            block: String::from_utf8_lossy(block).trim().to_owned(),
            form: None,
            times: 0,
        });
        finding.times += 1;
    }

    /// Ends the check and returns the result. `refused`: the line of a refused block, and the reason.
    pub fn finish(self, refused: Option<(u64, String)>) -> Fitted {
        let mut fit = Fit::of(self.machine, &self.travels);
        let mut findings = self.travels.findings(self.control);
        findings.extend(fit.findings(self.machine, self.control));
        findings.extend(self.found.into_values());
        findings.sort_by_key(|finding| finding.line);
        for (point, name) in ["G28", "G30", "G30 with P3 or more"].into_iter().enumerate() {
            if self.no_reference[point] {
                fit.not_checked.push(format!("the position of {name}: it is not in [reference]"));
            }
        }
        let unframed: String =
            (0..3).filter(|axis| self.places.unframed & 1 << axis != 0).map(|axis| LETTERS[axis]).collect();
        if !unframed.is_empty() {
            fit.not_checked.push(format!(
                "positions of {unframed} after a G92 or G10 at an unknown machine position: the position is unknown \
                 after G53, and before the first position with a tool length"
            ));
        }
        if self.places.astray {
            fit.not_checked.push("increments from an unknown machine position, for example after a tool change".into());
        }
        if self.hides_zero {
            fit.not_checked.push("positions with M92: the machine builder defines their zero".into());
        }
        if self.hides_length {
            fit.not_checked.push(
                "positions with G53, G153 or SUPA while D is active: a setting of the machine (MD10760) decides whether \
                 the tool length counts; write D0 in these blocks"
                    .into(),
            );
        }
        if self.was_compensated {
            fit.not_checked
                .push("cutter compensation: the programmed path is checked, not the path of the tool's centre".into());
        }
        if let Some((line, why)) = &refused {
            fit.not_checked.push(format!("everything from line {line} on: {why}"));
        }
        let (times, block_times) = match self.clock.map(Clock::finish) {
            Ok((times, blocks)) => (Ok(times), blocks),
            Err(lacks) => (Err(lacks), Vec::new()),
        };
        let has_travel = |axis: &usize| self.machine.axes[*axis].as_ref().is_some_and(|axis| axis.travel.is_some());
        let axes = if self.control.is_lathe() { &[0, 2][..] } else { &[0, 1, 2] };
        let without: Vec<String> =
            axes.iter().filter(|axis| !has_travel(axis)).map(|axis| LETTERS[*axis].to_string()).collect();
        if !without.is_empty() {
            fit.not_checked.push(format!("the travel of {}: it is not in the file", without.join(", ")));
        }
        if let Err(lacks) = &times {
            fit.not_checked.push(format!("times with accelerations: the file does not give {lacks}"));
        }
        Fitted { findings, fit, times, block_times, refused }
    }
}
