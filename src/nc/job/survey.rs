//! The first run of a program that is read as a job. The first run collects the data that the second run needs before
//! the first move.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::fault::{refused, unsaid, warning};
use super::options::JobOptions;
use crate::control::{Code, Control, Meaning, ToolLength};
use crate::diag::{self, Diag, Location};
use crate::lang::Machine;
use crate::nc::action::{Action, Compensation, Cutter, Item, Position};
use crate::nc::simulator::Simulator;
use crate::source::text_of;
use crate::toolpath::{About, ReadError, Start, Units};

/// The registers that a tool uses between its tool change and the next one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Registers {
    pub length: Option<f64>,
    pub diameter: Option<f64>,
}

/// Data about the whole program.
#[derive(Debug, Default)]
pub(super) struct Survey {
    pub program: Option<f64>,
    /// The comment after the number of the program.
    pub name: Option<String>,
    pub units: Option<Units>,
    /// The registers for each tool change. The first entry is for moves before the first tool change.
    pub registers: Vec<Registers>,
    /// Bit mask of the rotary axes that move.
    pub rotary: u8,
    /// The highest Z in the program, in work coordinates and in the units at the beginning of the program.
    pub top: f64,
}

impl Survey {
    /// The head of the job: number, name and units.
    ///
    /// # Errors
    /// The units are unknown.
    pub fn start(&self, machine: Machine) -> Result<Start, Box<Diag>> {
        let Some(units) = self.units else {
            let message = "the units of the program are unknown: it has no G20 or G21";
            let help = "give the units with `--assume-units inch` or `mm`";
            return Err(Box::new(Diag::new(diag::Code::PL005, message).help(help).place(Location::at(1, 1))));
        };
        Ok(Start {
            program: self.program,
            name: self.name.clone(),
            about: About::default(),
            units,
            machine,
            set: Vec::new(),
            tool_order: None,
        })
    }
}

/// Runs the program once.
pub(super) fn survey(
    simulator: &mut Simulator<'_>,
    options: &JobOptions,
    warnings: &mut Vec<Diag>,
) -> Result<Survey, ReadError> {
    let survey = Survey {
        registers: vec![Registers::default()],
        top: f64::NEG_INFINITY,
        units: options.units,
        ..Survey::default()
    };
    let mut run = Run {
        survey,
        warnings,
        left_out: BTreeMap::new(),
        length: None,
        inherited: false,
        with_length: false,
        without_length: false,
        told: false,
        at_home: false,
        told_of_home: false,
        unknown: Vec::new(),
        greatest: 0.0,
        moved: false,
        last: [0.0; 6],
        base: None,
    };
    let (mut items, mut named) = (Vec::new(), false);
    loop {
        items.clear();
        let more = simulator.step(&mut items).map_err(refused)?;
        for item in &items {
            run.take(item, simulator)?;
        }
        if !more {
            break;
        }
        // the name of a program is the comment after the program number
        if !named && simulator.program().is_some() {
            named = true;
            let name = simulator.comment().map(|name| text_of(name).trim().to_owned());
            run.survey.name = name.filter(|name| !name.is_empty());
        }
    }
    run.end(simulator)
}

/// The state of the first run.
struct Run<'w> {
    survey: Survey,
    warnings: &'w mut Vec<Diag>,
    /// The codes that a job can't contain, or a word or statement in their place, with the line of the first one and
    /// their number.
    left_out: BTreeMap<(Option<Code>, String), (u64, u64)>,
    /// The active length register. 0: a code has turned the length off. `None`: no code has turned a length on or off.
    length: Option<f64>,
    /// Whether the length register was turned on for the tool before this one.
    inherited: bool,
    /// Whether this tool has cut while its length offset was on.
    with_length: bool,
    /// Whether this tool has cut before any code for its length.
    without_length: bool,
    /// Whether a cut without a length offset was reported.
    told: bool,
    /// Whether the tool went home by a code that ends the length offset.
    at_home: bool,
    /// Whether a cut after such a move home was reported.
    told_of_home: bool,
    /// The names of tools whose numbers are unknown, with the line of the first call.
    unknown: Vec<(Arc<str>, u64)>,
    /// The greatest tool number.
    greatest: f64,
    /// Whether the program has moved to a known position.
    moved: bool,
    /// The last position.
    last: Position,
    /// The shift along Z at the first known height. Z of the job is measured in this frame.
    base: Option<f64>,
}

impl Run<'_> {
    fn take(&mut self, item: &Item, simulator: &Simulator<'_>) -> Result<(), ReadError> {
        let (line, shift) = (item.line, simulator.state().shift()[2]);
        match &item.action {
            Action::Rapid { to, machine, .. } => self.reach(to, *machine, shift),
            Action::Feed { to, .. } => {
                self.cut(line)?;
                self.reach(to, 0, shift);
            }
            Action::Arc(turn) => {
                self.cut(line)?;
                self.reach(&turn.to, 0, shift);
            }
            Action::Units(now) => {
                if self.moved && self.survey.units.is_some_and(|units| units != *now) {
                    let help = "write the program in one unit: a job has one unit";
                    return unsaid(line, "the program changes its units after its first move", help);
                }
                self.survey.units = Some(*now);
            }
            Action::Length(None) if simulator.ends_length() => self.at_home = true,
            Action::Length(None) => self.length = self.off(simulator),
            Action::Length(Some(0.0)) => {
                let help = "write G43 with H, and the length in the register of the machine";
                return unsaid(line, "a length offset in the block (G43.1)", help);
            }
            Action::Length(Some(register)) if *register < 0.0 => {
                let help = "write G43, and change the sign of the length in the register";
                return unsaid(line, "G44, a subtracted length offset", help);
            }
            Action::Tool(tool) => self.tool(*tool, simulator.state().tool_name(*tool), line),
            Action::Length(Some(register)) => {
                (self.length, self.inherited, self.at_home) = (Some(*register), false, false);
                one(&mut self.survey.registers, |r| &mut r.length, *register, line, "length offsets, H")?;
            }
            Action::Compensation(Some(Compensation { cutter: Cutter::Register(register), .. })) => {
                one(&mut self.survey.registers, |r| &mut r.diameter, *register, line, "diameter offsets, D")?;
            }
            Action::LeftOut(_, Meaning::RigidAhead) => {}
            Action::LeftOut(code, Meaning::SetOffsets) if self.moved && simulator.sets_tool_data() => {
                let help = "set the tool data at the machine, or before the first move of the program";
                return unsaid(line, format!("{code} sets tool data between moves"), help);
            }
            Action::LeftOut(code, _) => self.counts_left_out(Some(*code), "", line),
            Action::BlockDelete => self.counts_left_out(None, "block delete", line),
            Action::LeftOutWord(word) => self.counts_left_out(None, word, line),
            _ => {}
        }
        Ok(())
    }

    /// The length register after a code that turns the length off. The head of a program may contain G49 also on a
    /// machine without tool lengths, so G49 counts only after a tool change or after a length.
    fn off(&self, simulator: &Simulator<'_>) -> Option<f64> {
        let control = simulator.state().control;
        let has_lengths = !control.is_lathe() && control.traits().tool_length != ToolLength::None;
        (has_lengths && (self.survey.registers.len() > 1 || self.length.is_some())).then_some(0.0)
    }

    /// Checks the length offset at a cut.
    fn cut(&mut self, line: u64) -> Result<(), ReadError> {
        if std::mem::take(&mut self.at_home) && !std::mem::replace(&mut self.told_of_home, true) {
            let message = "a tool cuts after G28, G30 or G53 without another G43: the job assumes that its length \
                           offset is active again";
            let help = "check the manual of the control: many controls end the length offset at the machine zero";
            self.warnings.push(warning(line, message, help));
        }
        match self.length {
            None | Some(0.0) if self.with_length => {
                let help = "turn the length offset off after the tool's last cut: in a job a tool has one length";
                return unsaid(line, "a tool cuts with its length offset, and after G49 also without it", help);
            }
            Some(1.0..) if self.without_length => {
                let help = "turn the length offset on before the tool's first cut: in a job a tool has one length";
                return unsaid(line, "a tool cuts without its length offset, and after G43 also with it", help);
            }
            Some(0.0) => {
                one(&mut self.survey.registers, |r| &mut r.length, 0.0, line, "length offsets, H")?;
                if !std::mem::replace(&mut self.told, true) {
                    let message = "a tool cuts without a length offset, which G49 or register 0 has turned off: the \
                                   job's tool has register 0";
                    let help = "if the machine has tool lengths, turn the tool's own offset on in this program (G43 \
                                H1); if it has none, remove G49 or H0, and the form prints the tool's own offset";
                    self.warnings.push(warning(line, message, help));
                }
            }
            None if !std::mem::replace(&mut self.told, true) => {
                let message = "a tool cuts without a length offset, but the form turns the offset of the tool on";
                let help = "check whether the machine has tool lengths, and the values in its registers";
                self.warnings.push(warning(line, message, help));
            }
            Some(register) if std::mem::take(&mut self.inherited) => {
                one(&mut self.survey.registers, |r| &mut r.length, register, line, "length offsets, H")?;
                let message = format!("a tool cuts with length offset H{register}, which an earlier tool turned on");
                let help = "if the tool's own length is correct, write G43 with its H after M6";
                self.warnings.push(warning(line, message, help));
            }
            _ => {}
        }
        self.with_length |= self.length.is_some_and(|register| register != 0.0);
        self.without_length |= self.length.is_none();
        Ok(())
    }

    /// Records a position. `machine`: as bits, the axes whose position is known only at the machine.
    fn reach(&mut self, to: &Position, machine: u8, shift: f64) {
        self.moved |= machine & 0b111 != 0b111;
        for axis in (3..6).filter(|&axis| to[axis] != self.last[axis]) {
            self.survey.rotary |= 1 << axis;
        }
        self.last = *to;
        if machine & 0b100 == 0 {
            // Z is measured in the frame of the first move, as in the job
            self.survey.top = self.survey.top.max(to[2] + shift - *self.base.get_or_insert(shift));
        }
    }

    /// Records a tool change. `name`: the name of a tool whose number is unknown.
    fn tool(&mut self, number: f64, name: Option<Arc<str>>, line: u64) {
        match name {
            Some(name) if !self.unknown.iter().any(|(known, _)| *known == name) => self.unknown.push((name, line)),
            Some(_) => {}
            None => self.greatest = self.greatest.max(number),
        }
        self.survey.registers.push(Registers::default());
        (self.inherited, self.at_home) = (true, false);
        (self.with_length, self.without_length) = (false, false);
    }

    /// Counts a code, or a word in its place, that a job can't contain.
    fn counts_left_out(&mut self, code: Option<Code>, word: &str, line: u64) {
        self.left_out.entry((code, word.to_owned())).or_insert((line, 0)).1 += 1;
    }

    /// Reports what a job can't contain.
    ///
    /// # Errors
    /// The number of a tool is unknown.
    fn end(mut self, simulator: &Simulator<'_>) -> Result<Survey, ReadError> {
        if let Some((name, line)) = self.unknown.first() {
            let numbers = (1..).map(|count: u32| self.greatest + f64::from(count));
            let all = self.unknown.iter().zip(numbers).map(|((name, _), number)| format!("{name}={number}"));
            let help = format!("give the numbers with `--assume-tool '{}'`", all.collect::<Vec<_>>().join(","));
            let message = format!("the number of the tool \"{name}\" is unknown");
            return Err(Box::new(Diag::new(diag::Code::PL009, message).help(help).place(Location::at(*line, 1))).into());
        }
        for ((code, word), (line, count)) in self.left_out {
            let name = code.map_or(word, |code| code.to_string());
            let times = if count > 1 { format!(", {count} times") } else { String::new() };
            let message = format!("{name}{times} is left out: a job can't contain it");
            let control = simulator.state().settings.control;
            let help = match code.filter(|code| is_of_builder(*code, control)) {
                Some(code) => format!(
                    "if {code} has another meaning on your machine, such as coolant, make a control file (`postform new \
                     --control-file {} -o my-control.toml`), write `\"{code}\" = {{ is = \"through\" }}` (or the meaning \
                     it has, such as flood or coolant-off) under [codes], and give --job-control my-control.toml; \
                     otherwise, if the machine needs it, let the form print it",
                    control.name()
                ),
                None => "if the machine needs it, let the form print it".to_owned(),
            };
            self.warnings.push(warning(line, message, &help));
        }
        if simulator.begins_again() {
            let message = "the program ends with M99 and begins again, but a job runs only once";
            self.warnings.push(warning(simulator.line(), message, "print M99 in the sequence EndCode"));
        }
        self.survey.program = simulator.program();
        Ok(self.survey)
    }
}

/// Whether the code is an M code of the machine's builder, to which the control gives no effect on the motions.
fn is_of_builder(code: Code, control: &Control) -> bool {
    code.letter == b'M' && matches!(control.meaning(code), None | Some(Meaning::Harmless | Meaning::Unsaid))
}

/// Records the register of a tool. A tool may have only one register of each kind.
fn one(
    registers: &mut [Registers],
    which: impl Fn(&mut Registers) -> &mut Option<f64>,
    value: f64,
    line: u64,
    name: &str,
) -> Result<(), Box<Diag>> {
    let Some(tool) = registers.last_mut() else { return Ok(()) };
    match which(tool).replace(value) {
        Some(before) if before != value => {
            let message = format!("one tool uses two {name}{before} and {value}");
            unsaid(
                line,
                message,
                "in a job a tool has one offset of each kind: use one register, or change the tool between the offsets",
            )
        }
        _ => Ok(()),
    }
}
