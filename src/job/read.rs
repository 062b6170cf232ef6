//! Readers of the job formats, with options for the information that the text of a job may lack.

use std::cell::Cell;
use std::io::{self, Read, Seek};
use std::rc::Rc;

use super::{Format, Reading};
use crate::cl::{self, Assumed, Report, read_cl};
use crate::control::Control;
use crate::nc::{JobOptions, RunSettings, read_program};
use crate::nci::{self, read_nci};
use crate::remarks::Remarks;
use crate::toolpath::json::{read_document, read_lines};
use crate::toolpath::{ReadError, Sink, Units};

/// Reads a job in a format that is read from beginning to end.
pub(super) fn read_once(
    input: impl Read,
    format: Format,
    reading: &Reading,
    report: &mut Report,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    match format {
        Format::JsonLines => read_lines(input, sink),
        Format::Cl => read_cl(input, &cl_options(reading), report, sink),
        Format::Nci => {
            let mut own = Remarks::default();
            let read = read_nci(input, &nci::Options { units: reading.units }, &mut own, sink);
            report.add(own);
            read
        }
        _ => read_document(input, sink),
    }
}

/// The options for a CL file.
pub(super) fn cl_options(reading: &Reading) -> cl::Options {
    cl::Options {
        dialect: reading.dialect,
        units: reading.units,
        tool: reading.tool.clone(),
        speed: reading.speed,
        feed: reading.feed,
        start: reading.start,
        end: reading.end,
        setup: reading.setup,
    }
}

/// Reads an NC program, which is run twice.
pub(super) fn read_nc(
    input: impl io::Read + Seek,
    reading: &Reading,
    report: &mut Report,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    let settings = RunSettings {
        unpointed: reading.unpointed,
        units: reading.units.unwrap_or(Units::Mm),
        assumed: reading.control.is_none(),
        ..RunSettings::new(reading.control.unwrap_or_else(Control::usual))
    };
    let tool = reading.tool.as_ref().and_then(Assumed::one);
    let tool_names = reading.tool.as_ref().map_or(&[][..], Assumed::named);
    let options = JobOptions { settings, units: reading.units, tool, tool_names, start: reading.start };
    read_program(input, &options, &mut report.warnings, sink)
}

/// Reads a document of FreeCAD; an archive is not read in sequence.
#[cfg(feature = "freecad")]
pub(super) fn read_document_of_freecad(
    input: impl Read + Seek,
    reading: &Reading,
    report: &mut Report,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    use crate::freecad::{self, read_freecad};
    let mut own = Remarks::default();
    let read = read_freecad(input, &freecad::Options { job: reading.job.clone() }, &mut own, sink);
    report.add(own);
    read
}

/// Reports that this build can't read documents of FreeCAD.
#[cfg(not(feature = "freecad"))]
pub(super) fn read_document_of_freecad(
    _: impl Read + Seek,
    _: &Reading,
    _: &mut Report,
    _: &mut dyn Sink,
) -> Result<(), ReadError> {
    let diag = crate::diag::Diag::new(crate::diag::Code::PD001, "this build of postform can't read FreeCAD documents")
        .help("build it with the feature `freecad`");
    Err(ReadError::Job(Box::new(diag)))
}

/// Counts the bytes that are read.
pub(super) struct Counted<R> {
    pub input: R,
    pub count: Rc<Cell<u64>>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let count = self.input.read(out)?;
        self.count.set(self.count.get() + count as u64);
        Ok(count)
    }
}

impl<R: Seek> Seek for Counted<R> {
    fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
        self.input.seek(to)
    }
}
