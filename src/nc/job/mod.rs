//! An NC program as a job: its motions, with its cycles kept as cycles, for another form to print.

mod cycles;
mod operations;
mod reader;
mod survey;
mod switches;

use std::io::{BufRead, Seek};

use super::settings::RunSettings;
use super::simulator::{RunError, Simulator};
use crate::diag::{Code, Diag, Location};
use crate::toolpath::{ReadError, Sink, Stop, Units};
use reader::Reader;
use survey::survey;

/// How a program is read as a job.
#[derive(Clone, Copy, Debug)]
pub struct JobOptions {
    /// Control of the program, and how it is run.
    pub settings: RunSettings,
    /// Units of a program that says none.
    pub units: Option<Units>,
    /// Number of the first tool, for a program that cuts before it loads one.
    pub tool: Option<f64>,
}

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

/// What stopped the simulator stops the reader.
fn refused(error: RunError) -> ReadError {
    match error {
        RunError::Io(error) => ReadError::Io(error),
        RunError::Refused(diag, _) => ReadError::Job(diag),
    }
}

/// What pushing events returns.
type Done = Result<(), Stop>;

/// Something that no job can say.
fn unsaid<T, E: From<Box<Diag>>>(line: u64, message: impl Into<String>, help: &str) -> Result<T, E> {
    Err(Box::new(Diag::new(Code::PN036, message).help(help).place(Location::at(line, 1))).into())
}

/// Something that is said otherwise, or left out.
fn warning(line: u64, message: impl Into<String>, help: &str) -> Diag {
    Diag::new(Code::PN035, message).help(help).place(Location::at(line, 1))
}
