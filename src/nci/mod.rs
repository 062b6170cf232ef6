//! Mastercam NCI files as toolpaths.
//!
//! An NCI file is pairs of lines: the number of a record, then its values. Positions are absolute, in the units of the part, which no
//! record names. What the numbers mean is taken from the sources of NCCS PostWorks (`ncilod.f`, `ncimot.f`), and was compared with
//! programs that Mastercam's own posts printed (docs/sources/mastercam.md). What is disputed or unknown is refused.

mod convert;
mod drilling;
mod motion;
mod records;
mod tool;

use std::io::Read;

use crate::diag::{Code, Diag};
use crate::remarks::Remarks;
use crate::toolpath::{ReadError, Sink, Units};
use convert::Convert;
use records::Records;

/// What a file does not contain.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// The units of the file.
    pub units: Option<Units>,
}

/// Reads a file and pushes its events.
///
/// # Errors
/// The input fails or is no NCI file; its units are not given; a record is cut off, or contains what no job can have.
pub fn read_nci(
    input: impl Read,
    options: &Options,
    report: &mut Remarks,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    let mut records = Records::new(input);
    let mut convert = Convert::new(options, report, sink);
    while let Some(record) = records.next()? {
        if convert.is_over() {
            return Err(wrong(
                Code::PI001,
                "a record after the end of the file (1003)",
                "cut the file off there",
                record.line,
            ));
        }
        convert.take(&record)?;
    }
    convert.end(records.line())
}

/// An error at a line.
fn wrong<E: From<Box<Diag>>>(code: Code, message: impl Into<String>, help: impl Into<String>, line: u64) -> E {
    let place = crate::diag::Location::line(line);
    Box::new(Diag::new(code, message).help(help).place(place)).into()
}
