//! Reads an NC program as a job, so that another form can print the job. Canned cycles of the program remain cycles.

mod behind;
mod cycles;
mod fault;
mod holes;
mod home;
mod moves;
mod operations;
mod options;
mod pattern;
mod reader;
mod shift;
mod survey;
mod switches;
mod turning;

use std::io::{Read, Seek};
use std::path::Path;

use super::action::Item;
use super::foreign::settings_for;
use super::settings::RunSettings;
use super::simulator::Simulator;
use crate::diag::Diag;
use crate::toolpath::{ReadError, Sink};
use behind::Behind;
use fault::{Done, refused, unsaid};
pub use options::JobOptions;
use reader::Reader;
use survey::survey;
use turning::Turner;

/// Reads a program as a job. The program is run twice: the first run checks that the control accepts the program, and
/// collects data such as the registers of the tools.
///
/// `warnings` gets the findings about parts of the program that the job changes or leaves out.
///
/// # Errors
/// The input can't be read, the control refuses the program, or a job can't contain a part of the program.
pub fn read_program(
    mut input: impl Read + Seek,
    options: &JobOptions,
    warnings: &mut Vec<Diag>,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    let settings = settings_for(&mut input, Path::new(""), options.settings).map_err(ReadError::Io)?;
    let options = &JobOptions { settings, ..*options };
    if options.settings.control.is_wire() {
        return unsaid(
            1,
            "the program is for a wire EDM machine",
            "only programs of mills and lathes can be read as jobs",
        );
    }
    let mut said = Vec::new();
    let read = read_twice(input, options, &mut said, sink);
    warnings.extend(counted(said));
    read
}

/// Merges equal warnings into one warning that contains their number.
fn counted(warnings: Vec<Diag>) -> Vec<Diag> {
    let mut kinds: Vec<(Diag, u64)> = Vec::new();
    for warning in warnings {
        match kinds.iter_mut().find(|(kind, _)| kind.code == warning.code && kind.message == warning.message) {
            Some((_, count)) => *count += 1,
            None => kinds.push((warning, 1)),
        }
    }
    let told = |(mut warning, count): (Diag, u64)| {
        if count > 1 {
            warning.message += &format!(" ({count} times, the first here)");
        }
        warning
    };
    kinds.into_iter().map(told).collect()
}

fn read_twice(
    input: impl Read + Seek,
    options: &JobOptions,
    warnings: &mut Vec<Diag>,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    // boring tools move away from the wall in the same direction as in a job whose bore has an angle of zero
    let settings = RunSettings { places_unknown: true, bore_shift: -1.0, ..options.settings };
    let mut simulator = Simulator::new(input, settings);
    know_tools(&mut simulator, options);
    let survey = survey(&mut simulator, options, warnings)?;
    let mut simulator = simulator.again().map_err(ReadError::Io)?;
    know_tools(&mut simulator, options);
    if options.settings.control.is_lathe() {
        let mut turner = Turner::new(&survey, options, warnings, sink, simulator.state().modes.feed_mode)?;
        run(&mut simulator, |item, text, _| turner.take(item, text))?;
        return Ok(turner.finish()?);
    }
    let mut reader = Reader::new(&survey, options, warnings, sink);
    run(&mut simulator, |item, text, behind| reader.take(item, text, behind))?;
    Ok(reader.finish()?)
}

fn know_tools(simulator: &mut Simulator<'_>, options: &JobOptions<'_>) {
    for (name, number) in options.tool_names {
        simulator.know_tool(name, *number);
    }
}

/// Runs the program. For each action, calls `take` with the action, the text of its block, and the state of the machine
/// after the block.
fn run(simulator: &mut Simulator<'_>, mut take: impl FnMut(&Item, &[u8], Behind) -> Done) -> Result<(), ReadError> {
    let mut items = Vec::new();
    loop {
        items.clear();
        let more = simulator.step(&mut items).map_err(refused)?;
        let behind = Behind::of(simulator.state());
        for item in &items {
            take(item, simulator.text(), behind)?;
        }
        if !more {
            return Ok(());
        }
    }
}
