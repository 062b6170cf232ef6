//! Runs a program on a machine, with the machine's offsets and from an unknown position.

use std::io::{self, Read, Seek, SeekFrom};

use super::check::Check;
use super::fitted::{Fitted, Known};
use crate::machine::Machine;
use crate::nc::{RunError, RunSettings, Simulator};

/// Runs a program on a machine.
///
/// # Errors
/// The program can't be read.
pub fn preflight(
    program: impl Read + Seek,
    settings: RunSettings,
    machine: &Machine,
    known: &Known,
) -> io::Result<Fitted> {
    run(program, settings, machine, known, false)
}

/// Runs a program on a machine, and records the time of each block.
///
/// # Errors
/// The program can't be read.
pub fn preflight_by_block(
    program: impl Read + Seek,
    settings: RunSettings,
    machine: &Machine,
    known: &Known,
) -> io::Result<Fitted> {
    run(program, settings, machine, known, true)
}

fn run(
    mut program: impl Read + Seek,
    settings: RunSettings,
    machine: &Machine,
    known: &Known,
    by_block: bool,
) -> io::Result<Fitted> {
    let bytes = program.seek(SeekFrom::End(0))?;
    program.seek(SeekFrom::Start(0))?;
    let settings = RunSettings { places_unknown: true, ..settings };
    let mut run = Simulator::new(program, settings);
    let offsets = machine.offsets.iter().flatten().map(|(number, at)| (*number, at.map(|value| value.unwrap_or(0.0))));
    run.begin_on(&mut offsets.into_iter(), machine.references.map(Option::unwrap_or_default));
    let in_table = machine.tools.iter().flat_map(|table| &table.0).map(|(number, tool)| (*number, &tool.name));
    let in_table = in_table.filter_map(|(number, name)| Some((number, name.as_ref()?)));
    let in_job = known.tools.iter().filter_map(|tool| Some((tool.number, tool.name.as_ref()?)));
    for (number, name) in in_table.chain(in_job) {
        run.know_tool(name, f64::from(number));
    }
    let mut check = Check::new(machine, settings.control, known);
    if by_block {
        check.keep_blocks();
    }
    let mut items = Vec::new();
    let refused = loop {
        items.clear();
        match run.step(&mut items) {
            Ok(more) => {
                check.block(&items, &run);
                if !more {
                    break None;
                }
            }
            Err(RunError::Refused(diag, line)) => {
                check.block(&items, &run);
                break Some((line, diag.message.clone()));
            }
            Err(RunError::Io(error)) => return Err(error),
        }
    };
    check.memory(bytes, run.program());
    Ok(check.finish(refused))
}
