//! Reads NCI files of Mastercam as toolpaths.
//!
//! A record of an NCI file is two lines: the number of the record, and its values. Positions are absolute, in the units
//! of the part; no record contains the units. The meanings of the numbers come from the sources of NCCS PostWorks
//! (`ncilod.f`, `ncimot.f`). The meanings were compared with programs that Mastercam's own posts printed
//! (docs/sources/mastercam.md). Records whose meaning is disputed or unknown are refused.

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

/// Information that the caller must give because an NCI file does not contain it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// The units of the lengths in the file.
    pub units: Option<Units>,
}

/// Reads a file and pushes its events.
///
/// # Errors
/// The input can't be read or is not an NCI file, its units are not given, a record is incomplete, or a record contains
/// something that a job can't contain.
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
                "remove the lines after record 1003",
                record.line,
            ));
        }
        convert.take(&record)?;
    }
    convert.end(records.line())
}

/// The error for a line of the file.
fn wrong<E: From<Box<Diag>>>(code: Code, message: impl Into<String>, help: impl Into<String>, line: u64) -> E {
    let place = crate::diag::Location::line(line);
    Box::new(Diag::new(code, message).help(help).place(place)).into()
}
