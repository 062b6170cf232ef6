//! An NC program as a job: its motions, with its cycles kept as cycles, for another form to print.

mod cycles;
mod fault;
mod operations;
mod options;
mod reader;
mod survey;
mod switches;

use std::io::{BufRead, Seek};

use super::settings::RunSettings;
use super::simulator::Simulator;
use crate::diag::Diag;
use crate::toolpath::{ReadError, Sink};
use fault::refused;
pub use options::JobOptions;
use reader::Reader;
use survey::survey;

/// Reads a program as a job. It is run twice: once to see that the control takes it, and what its tools need.
///
/// `warnings` are what a job can't say.
///
/// # Errors
/// The input fails; the control refuses the program; the program does what no job can say.
pub fn read_program(
    input: impl BufRead + Seek,
    options: &JobOptions,
    warnings: &mut Vec<Diag>,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    // off the wall to the side that a job's bore has at angle zero
    let settings = RunSettings { places_unknown: true, bore_shift: -1.0, ..options.settings };
    let mut simulator = Simulator::new(input, settings);
    let survey = survey(&mut simulator, options, warnings)?;
    let mut simulator = simulator.again().map_err(ReadError::Io)?;
    let mut reader = Reader::new(&survey, options, warnings, sink);
    let mut items = Vec::new();
    loop {
        items.clear();
        let more = simulator.step(&mut items).map_err(refused)?;
        for item in &items {
            reader.take(item, simulator.text())?;
        }
        if !more {
            return Ok(reader.finish()?);
        }
    }
}
