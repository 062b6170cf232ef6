//! Reads FreeCAD documents as toolpaths: the job of a saved `.FCStd` file. FreeCAD itself is not needed.
//!
//! A document is a zip archive. `Document.xml` lists all objects. The path of each operation is a separate text file in
//! the archive. Lengths are in millimetres, feeds in millimetres per second and angles in degrees, whatever units
//! FreeCAD displays. Documents of 0.20 ("Path") and 1.1 ("CAM") have different class names and repeat tool changes at
//! different times. Comments in the code mention the differences between 0.20 and 1.1.

mod archive;
mod choose;
mod command;
mod convert;
mod cycles;
mod document;
mod order;
mod tools;

use std::io::{Read, Seek};

use crate::diag::{Code, Diag};
pub use crate::remarks::Remarks as Report;
use crate::toolpath::{About, Event, Hold, Place, ReadError, Sink, Start, Units};
use archive::Archive;
use convert::Convert;
use document::Document;

/// Which job of a document is read.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Name or label of the job. The name is needed if the document has several jobs.
    pub job: Option<String>,
}

/// Reads the job of a document.
///
/// # Errors
/// The input can't be read or is not a FreeCAD document. The document has no job, or several jobs. An operation
/// contains a command that jobs do not support, or has no tool, speed or feed.
pub fn read_freecad(
    input: impl Read + Seek,
    options: &Options,
    report: &mut Report,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    let mut archive = Archive::open(input)?;
    let document = Document::parse(&archive.whole("Document.xml", archive::LARGEST_DOCUMENT)?)?;
    let job = choose::job(&document, options.job.as_deref(), report)?;
    let steps = order::steps(&document, &job, report)?;
    for controller in order::controllers(&steps) {
        controller.check_saved(&mut archive)?;
    }
    let said = |property: &str| document.own.text(property).filter(|text| !text.is_empty()).map(str::to_owned);
    let mut hold = Hold::new(sink);
    let start = Start {
        program: None,
        name: Some(job.label.clone()),
        about: About { part: said("Label"), author: said("CreatedBy"), ..About::default() },
        units: Units::Mm,
        machine: crate::lang::Machine::Mill,
        set: Vec::new(),
        tool_order: Some(order::tools(&steps)),
    };
    hold.push(Event::Start(&start), Place::default())?;
    let mut place = Place::default();
    for step in &steps {
        place.operation += 1;
        let mut convert = Convert::begin(step, place, &mut hold)?;
        let path = archive.member(&step.path)?;
        command::each(step.path.as_deref().unwrap_or_default(), path, |line, command| convert.take(line, command))?;
        convert.end()?;
    }
    hold.push(Event::Finish, Place::default())?;
    Ok(())
}

/// Returns an error about the document.
fn wrong<T, E: From<Box<Diag>>>(code: Code, message: impl Into<String>, help: impl Into<String>) -> Result<T, E> {
    Err(Box::new(Diag::new(code, message).help(help)).into())
}
