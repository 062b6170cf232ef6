//! The first run of a program that is read as a job. The first run collects the data that the second run needs before
//! the first move.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::fault::{refused, unsaid, warning};
use super::options::JobOptions;
use crate::control::{Code, Meaning};
use crate::diag::{self, Diag, Location};
use crate::lang::Machine;
use crate::nc::action::Action;
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
    let mut survey = Survey { registers: vec![Registers::default()], top: f64::NEG_INFINITY, ..Survey::default() };
    let mut left_out: BTreeMap<Option<Code>, (u64, u64)> = BTreeMap::new();
    let mut items = Vec::new();
    // the active length register, and whether it was turned on for the tool before this one
    let (mut length, mut inherited) = (None, false);
    // whether this tool has cut while its length offset was on
    let mut with_length = false;
    let (mut told, mut named) = (false, false);
    // whether the tool went home by a code that ends the length offset, and whether the user was told about it
    let (mut at_home, mut told_of_home) = (false, false);
    // the names of tools whose numbers are unknown, with the line of the first call, and the greatest tool number
    let (mut unknown, mut greatest): (Vec<(Arc<str>, u64)>, f64) = (Vec::new(), 0.0);
    let (mut units, mut moved, mut last) = (options.units, false, [0.0; 6]);
    let mut base = None;
    loop {
        items.clear();
        let more = simulator.step(&mut items).map_err(refused)?;
        let shift = simulator.state().shift()[2];
        for item in &items {
            if let Action::Feed { .. } | Action::Arc(_) = &item.action {
                if std::mem::take(&mut at_home) && !std::mem::replace(&mut told_of_home, true) {
                    let message = "a tool cuts after G28, G30 or G53 without another G43: the job assumes that its length \
                                   offset is active again";
                    let help =
                        "check the manual of the control: many controls end the length offset at the machine zero";
                    warnings.push(warning(item.line, message, help));
                }
                match length {
                    None if with_length => {
                        let help =
                            "turn the length offset off after the tool's last cut: in a job a tool has one length";
                        return unsaid(
                            item.line,
                            "a tool cuts with its length offset, and after G49 also without it",
                            help,
                        );
                    }
                    None if !std::mem::replace(&mut told, true) => {
                        let message =
                            "a tool cuts without a length offset, but the form turns the offset of the tool on";
                        let help = "check whether the machine has tool lengths, and the values in its registers";
                        warnings.push(warning(item.line, message, help));
                    }
                    Some(register) if std::mem::take(&mut inherited) => {
                        one(&mut survey.registers, |r| &mut r.length, register, item.line, "length offsets, H")?;
                        let message =
                            format!("a tool cuts with length offset H{register}, which an earlier tool turned on");
                        warnings.push(warning(
                            item.line,
                            message,
                            "if the tool's own length is correct, write G43 with its H after M6",
                        ));
                    }
                    _ => {}
                }
                with_length |= length.is_some();
            }
            let mut reach = |survey: &mut Survey, to: &[f64; 6], machine: u8| {
                moved |= machine & 0b111 != 0b111;
                for axis in 3..6 {
                    if to[axis] != last[axis] {
                        survey.rotary |= 1 << axis;
                    }
                }
                last = *to;
                if machine & 0b100 == 0 {
                    // Z is measured in the frame of the first move, as in the job
                    survey.top = survey.top.max(to[2] + shift - *base.get_or_insert(shift));
                }
            };
            match &item.action {
                Action::Rapid { to, machine, .. } => reach(&mut survey, to, *machine),
                Action::Feed { to, .. } => reach(&mut survey, to, 0),
                Action::Arc(turn) => reach(&mut survey, &turn.to, 0),
                Action::Units(now) => {
                    if moved && units.is_some_and(|units| units != *now) {
                        let help = "write the program in one unit: a job has one unit";
                        return unsaid(item.line, "the program changes its units after its first move", help);
                    }
                    units = Some(*now);
                }
                Action::Length(None) if simulator.ends_length() => at_home = true,
                Action::Length(None) => length = None,
                Action::Length(Some(register)) if *register < 0.0 => {
                    let help = "write G43, and change the sign of the length in the register";
                    return unsaid(item.line, "G44, a subtracted length offset", help);
                }
                Action::Tool(tool) => {
                    match simulator.state().tool_name(*tool) {
                        Some(name) if !unknown.iter().any(|(known, _)| *known == name) => {
                            unknown.push((name, item.line));
                        }
                        Some(_) => {}
                        None => greatest = greatest.max(*tool),
                    }
                    survey.registers.push(Registers::default());
                    (inherited, with_length, at_home) = (true, false, false);
                }
                Action::Length(Some(register)) => {
                    (length, inherited, at_home) = (Some(*register), false, false);
                    let line = item.line;
                    one(&mut survey.registers, |r| &mut r.length, *register, line, "length offsets, H")?;
                }
                Action::Compensation(Some((_, Some(register)))) => {
                    let line = item.line;
                    one(&mut survey.registers, |r| &mut r.diameter, *register, line, "diameter offsets, D")?;
                }
                Action::LeftOut(_, Meaning::RigidAhead) => {}
                Action::LeftOut(code, Meaning::SetOffsets) if moved && simulator.sets_tool_data() => {
                    let help = "set the tool data at the machine, or before the first move of the program";
                    return unsaid(item.line, format!("{code} sets tool data between moves"), help);
                }
                Action::LeftOut(code, _) => left_out.entry(Some(*code)).or_insert((item.line, 0)).1 += 1,
                Action::BlockDelete => left_out.entry(None).or_insert((item.line, 0)).1 += 1,
                _ => {}
            }
        }
        if !more {
            break;
        }
        // the name of a program is the comment after the program number
        if !named && simulator.program().is_some() {
            named = true;
            let name = simulator.comment().map(|name| text_of(name).trim().to_owned());
            survey.name = name.filter(|name| !name.is_empty());
        }
    }
    if let Some((name, line)) = unknown.first() {
        let numbers = (1..).map(|count: u32| greatest + f64::from(count));
        let all = unknown.iter().zip(numbers).map(|((name, _), number)| format!("{name}={number}"));
        let help = format!("give the numbers with `--assume-tool '{}'`", all.collect::<Vec<_>>().join(","));
        let message = format!("the number of the tool \"{name}\" is unknown");
        return Err(Box::new(Diag::new(diag::Code::PL009, message).help(help).place(Location::at(*line, 1))).into());
    }
    for (code, (line, count)) in left_out {
        let name = code.map_or("block delete".to_owned(), |code| code.to_string());
        let times = if count > 1 { format!(", {count} times") } else { String::new() };
        let message = format!("{name}{times} is left out: a job can't contain it");
        warnings.push(warning(line, message, "if the machine needs it, let the form print it"));
    }
    if simulator.begins_again() {
        let message = "the program ends with M99 and begins again, but a job runs only once";
        warnings.push(warning(simulator.line(), message, "print M99 in the sequence EndCode"));
    }
    survey.program = simulator.program();
    survey.units = units;
    Ok(survey)
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
