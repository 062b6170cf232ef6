//! Jobs: the work to be machined, in any format. A job turns bytes into events.

mod descent;
mod format;
mod held;
mod join;
mod kept;
mod left_out_text;
mod read;
mod select;
mod subs;

pub use format::Format;
pub use kept::KeptJob;
pub use select::Selection;

use join::Joining;
use read::{Counted, cl_options, read_document_of_freecad, read_nc, read_once};
use select::Selecting;
use std::cell::Cell;
use std::fmt;
use std::io::{self, BufReader, Cursor, Read, Seek};
use std::rc::Rc;

use crate::cl::{self, Assumed, AssumedSpeed, Dialect, Report, Setup};
use crate::control::Control;
use crate::diag::Diag;
use crate::error::Error;
use crate::nc::Unpointed;
use crate::toolpath::json::read_document_again;
use crate::toolpath::{Event, Flow, Hold, Place, ReadError, Sink, Stop, Units, flow};

/// Information that a CL file, NCI file or NC program may lack. Jobs in JSON need none of this information.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Reading {
    /// The CAM system that wrote a CL file; by default the system is recognised from the first lines.
    pub dialect: Option<Dialect>,
    /// Units of a CL file, NCI file or program without units.
    pub units: Option<Units>,
    /// The tool number of a CL file or program without a tool change, or of each tool that a CL file names.
    pub tool: Option<Assumed>,
    /// The spindle speed of tools for which a CL file gives no speed.
    pub speed: Option<AssumedSpeed>,
    /// The feed of a CL file without any feed, in units of the file per minute.
    pub feed: Option<f64>,
    /// The position before a CL file or program that begins with a cut, in the units of the file. A program that cuts
    /// from an unknown machine position also needs this position.
    pub start: Option<[f64; 3]>,
    /// Whether the CL file is complete even without the usual end statement of its system.
    pub end: bool,
    /// The setup of a CL file to read, counted from 1: the motions with one tool axis, in a frame of their own.
    pub setup: Option<usize>,
    /// The control whose rules an NC program follows; the default is Fanuc.
    pub control: Option<&'static Control>,
    /// The name or label of the job to read from a FreeCAD document with several jobs.
    pub job: Option<String>,
    /// The meaning of a length without a decimal point in an NC program of a Fanuc; by default the length is an error.
    pub unpointed: Unpointed,
    /// The operations to read.
    pub select: Selection,
}

/// An input that can be read and rewound.
trait Again: Read + Seek {}
impl<T: Read + Seek> Again for T {}

/// A function that pushes the events of a custom job.
type Maker<'a> = dyn FnMut(&mut dyn Sink) -> Result<(), ReadError> + 'a;

enum Input<'a> {
    Bytes(&'a [u8]),
    File(Box<dyn Again + 'a>),
    /// `None` after the stream was read.
    Stream(Option<Box<dyn Read + 'a>>),
    Events(Box<Maker<'a>>),
    /// Jobs that are read as one job, and their names.
    Joined(Vec<Job<'a>>, Rc<[String]>),
    Kept(Box<KeptJob>),
}

/// A job that can be read: its input and its format. The job is not read until it is rendered or verified.
pub struct Job<'a> {
    input: Input<'a>,
    format: Format,
    /// Information that the text of the job lacks.
    pub reading: Reading,
    report: Report,
    /// Number of bytes read so far.
    read: Rc<Cell<u64>>,
    /// The name of the job in findings.
    name: Option<Rc<str>>,
}

impl<'a> Job<'a> {
    fn new(format: Format, input: Input<'a>) -> Job<'a> {
        Job { input, format, reading: Reading::default(), report: Report::default(), read: Rc::default(), name: None }
    }

    /// One JSON document (`docs/job.md`).
    pub fn json(text: &'a (impl AsRef<[u8]> + ?Sized)) -> Job<'a> {
        Job::bytes(Format::Json, text)
    }

    /// JSON Lines: one item per line.
    pub fn json_lines(text: &'a (impl AsRef<[u8]> + ?Sized)) -> Job<'a> {
        Job::bytes(Format::JsonLines, text)
    }

    /// An APT CL file.
    pub fn cl(text: &'a (impl AsRef<[u8]> + ?Sized)) -> Job<'a> {
        Job::bytes(Format::Cl, text)
    }

    /// An NC program, which may be for another machine.
    pub fn nc(text: &'a (impl AsRef<[u8]> + ?Sized)) -> Job<'a> {
        Job::bytes(Format::Nc, text)
    }

    /// A job in this format.
    pub fn bytes(format: Format, text: &'a (impl AsRef<[u8]> + ?Sized)) -> Job<'a> {
        Job::new(format, Input::Bytes(text.as_ref()))
    }

    /// A job whose format is found by its name or else by its first bytes.
    ///
    /// # Errors
    /// The format is not recognised.
    pub fn open(name: &str, text: &'a (impl AsRef<[u8]> + ?Sized)) -> Result<Job<'a>, Error> {
        let format = Format::of_name(name).or_else(|| Format::of_content(text.as_ref()));
        let format = format.ok_or_else(|| {
            Error::usage(
                "the format of the job is unknown: its name and its beginning are not those of JSON, a CL file or an \
                 NC program",
            )
        })?;
        Ok(Job::bytes(format, text).named(name))
    }

    /// Sets the name of this job in the locations of errors, warnings and notes: `bracket.json:12:9`.
    pub fn named(mut self, name: &str) -> Job<'a> {
        self.name = Some(name.into());
        self
    }

    /// Adds the job's name to the locations of an error.
    pub(crate) fn names(&self, mut error: Error) -> Error {
        self.name_places(error.diags_mut());
        error
    }

    /// Adds the job's name to the locations in this job.
    pub(crate) fn name_places(&self, diags: &mut [Diag]) {
        for place in diags.iter_mut().filter_map(|diag| diag.place.as_mut()) {
            let name = match (&self.input, &self.name) {
                (Input::Joined(parts, _), _) => {
                    parts.get(usize::from(place.part).saturating_sub(1)).and_then(|part| part.name.as_deref())
                }
                (_, name) => name.as_deref(),
            };
            if let Some(name) = name {
                place.file.get_or_insert_with(|| name.to_owned());
            }
        }
    }

    /// A job in a file or another input that can be rewound. Every read starts from the beginning of the input, and the
    /// size of the input is not limited.
    pub fn file(format: Format, file: impl Read + Seek + 'a) -> Job<'a> {
        Job::new(format, Input::File(Box::new(file)))
    }

    /// A job from a stream, which can be read only once: it can be rendered or verified, but not both. An NC program is kept in
    /// memory because it is run twice. A FreeCAD document is kept because an archive is read from its end.
    pub fn stream(format: Format, input: impl Read + 'a) -> Job<'a> {
        Job::new(format, Input::Stream(Some(Box::new(input))))
    }

    /// A job of another format. `make` pushes the events of the job; each call pushes all events again. Tool changes
    /// may lack their first move: postform takes the move from the events after the tool change.
    ///
    /// [`Sink::push`] pushes an event; pass its result on with `?`. The last event is [`Event::Finish`].
    pub fn events(make: impl FnMut(&mut dyn Sink) -> Result<(), ReadError> + 'a) -> Job<'a> {
        Job::new(Format::Json, Input::Events(Box::new(make)))
    }

    /// Joins several jobs to one job, in which the operations of the jobs follow each other. Program number, name and
    /// other data of the head are taken from the first job. Locations in errors have the names of the jobs
    /// ([`Job::named`]).
    ///
    /// Reading fails (PJ014) if a job has other units than the first job, or another tool with a number that an earlier
    /// job uses. Reading also fails if an earlier job left a state active that the first operation of a later job does
    /// not set.
    pub fn join(parts: Vec<Job<'a>>) -> Job<'a> {
        let name =
            |(at, part): (usize, &Job<'_>)| part.name.as_deref().map_or(format!("job {}", at + 1), str::to_owned);
        let names = parts.iter().enumerate().map(name).collect();
        let format = parts.first().map_or(Format::Json, |part| part.format);
        Job::new(format, Input::Joined(parts, names))
    }

    /// Borrows the job, so that it can be rendered first and verified afterwards.
    pub fn again(&mut self) -> Job<'_> {
        let input = match &mut self.input {
            Input::Bytes(bytes) => Input::Bytes(bytes),
            Input::File(file) => Input::File(Box::new(file)),
            Input::Stream(input) => Input::Stream(input.take()),
            Input::Events(make) => Input::Events(Box::new(make)),
            Input::Joined(parts, names) => Input::Joined(parts.iter_mut().map(Job::again).collect(), Rc::clone(names)),
            Input::Kept(kept) => Input::Kept(kept.clone()),
        };
        Job { reading: self.reading.clone(), name: self.name.clone(), ..Job::new(self.format, input) }
    }

    /// Whether the job can be read only once.
    pub fn is_stream(&self) -> bool {
        match &self.input {
            Input::Stream(_) => true,
            Input::Joined(parts, _) => parts.iter().any(Job::is_stream),
            _ => false,
        }
    }

    /// Reads a stream into memory, so that it can be read more than once.
    pub(crate) fn hold(&mut self) -> Result<(), Error> {
        match &mut self.input {
            Input::Stream(Some(input)) => {
                let mut text = Vec::new();
                input.read_to_end(&mut text)?;
                self.input = Input::File(Box::new(Cursor::new(text)));
            }
            Input::Joined(parts, _) => parts.iter_mut().try_for_each(Job::hold)?,
            _ => {}
        }
        Ok(())
    }

    /// The format of the job.
    pub fn format(&self) -> Format {
        self.format
    }

    /// The report of the last read: warnings, and the information that a CL file contains about itself.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Takes the report.
    pub(crate) fn take_report(&mut self) -> Report {
        std::mem::take(&mut self.report)
    }

    /// The number of bytes read so far, counted during the read. `None`: the number of bytes read does not show the
    /// progress.
    pub(crate) fn bytes_read(&self) -> Option<Rc<Cell<u64>>> {
        (!matches!(self.input, Input::Events(_) | Input::Joined(..) | Input::Kept(_))).then(|| Rc::clone(&self.read))
    }

    /// Reads the job from its beginning and pushes its events. Memory does not grow with the job.
    ///
    /// # Errors
    /// The input fails, the job is wrong, or the sink can't do what the job requests. The report has the warnings up to that point.
    pub fn read(&mut self, sink: &mut dyn Sink) -> Result<(), Error> {
        self.read_by(Control::of_no_name(), sink)
    }

    /// Like [`Job::read`], with the control that defines the codes in text items. These codes matter only if the selection
    /// leaves out operations.
    pub(crate) fn read_by(&mut self, control: &'static Control, sink: &mut dyn Sink) -> Result<(), Error> {
        if matches!(self.input, Input::Stream(None)) {
            return Err(Error::usage("a job that comes as a stream can be read only once"));
        }
        self.report = Report::default();
        self.read.set(0);
        let selection = self.reading.select.clone();
        let read = match selection.is_all() {
            true => self.read_on(sink),
            false => {
                let mut selecting = Selecting::new(sink, &selection, control);
                let read = self.read_on(&mut selecting);
                self.report.left_out = selecting.skipped;
                read
            }
        };
        // a reader that detects changes to its file reports them here
        if let Input::File(input) = &mut self.input {
            input.rewind()?;
        }
        match read {
            Ok(()) | Err(ReadError::Stopped) => Ok(()),
            Err(ReadError::Io(error)) => Err(error.into()),
            Err(ReadError::Job(diag)) => Err(diag.into()),
        }
    }

    /// The units of the job; `None` for a job without events. The job is read until its units are known.
    ///
    /// # Errors
    /// As [`Job::read`].
    pub fn units(&mut self) -> Result<Option<Units>, Error> {
        let mut first = FirstUnits(None);
        self.read(&mut first)?;
        Ok(first.0)
    }

    /// The setups of a CL file: runs of motions with one tool axis; `reading.setup` selects one. Empty if the job is no CL file
    /// or comes from a stream.
    ///
    /// # Errors
    /// The input fails, or a line is not a statement.
    pub fn setups(&mut self) -> Result<Vec<Setup>, Error> {
        let options = cl::Options { setup: None, ..cl_options(&self.reading) };
        let found = match &mut self.input {
            Input::Bytes(bytes) if self.format == Format::Cl => cl::setups(*bytes, &options),
            Input::File(input) if self.format == Format::Cl => {
                input.rewind()?;
                cl::setups(input, &options)
            }
            _ => Ok(Vec::new()),
        };
        match found {
            Ok(setups) => Ok(setups),
            Err(ReadError::Stopped) => Ok(Vec::new()),
            Err(ReadError::Io(error)) => Err(error.into()),
            Err(ReadError::Job(diag)) => Err(diag.into()),
        }
    }

    fn read_on(&mut self, sink: &mut dyn Sink) -> Result<(), ReadError> {
        let count = Rc::clone(&self.read);
        let (format, reading, report) = (self.format, &self.reading, &mut self.report);
        match &mut self.input {
            Input::Bytes(bytes) => {
                // the whole text is in memory
                count.set(bytes.len() as u64);
                match format {
                    Format::Nc => read_nc(Cursor::new(*bytes), reading, report, sink),
                    Format::Freecad => read_document_of_freecad(Cursor::new(*bytes), reading, report, sink),
                    Format::Json => read_document_again(Cursor::new(*bytes), sink),
                    _ => read_once(*bytes, format, reading, report, sink),
                }
            }
            Input::File(input) => {
                input.rewind()?;
                let input = Counted { input, count };
                match format {
                    Format::Nc => read_nc(input, reading, report, sink),
                    Format::Json => read_document_again(input, sink),
                    Format::Freecad => {
                        let input = BufReader::with_capacity(DOCUMENT_BUFFER, input);
                        read_document_of_freecad(input, reading, report, sink)
                    }
                    _ => read_once(input, format, reading, report, sink),
                }
            }
            Input::Stream(input) => {
                let again = || io::Error::other("a job that comes as a stream can be read only once");
                let input = input.take().ok_or_else(again)?;
                let mut input = Counted { input, count };
                match format {
                    Format::Nc | Format::Freecad => {
                        let mut text = Vec::new();
                        input.read_to_end(&mut text)?;
                        let text = Cursor::new(text);
                        match format {
                            Format::Nc => read_nc(text, reading, report, sink),
                            _ => read_document_of_freecad(text, reading, report, sink),
                        }
                    }
                    _ => read_once(input, format, reading, report, sink),
                }
            }
            Input::Events(make) => make(&mut Ahead(Hold::new(sink))),
            Input::Kept(kept) => {
                *report = kept.report.clone();
                kept.read(sink)
            }
            Input::Joined(parts, names) => {
                let mut joining = Joining::new(sink, names);
                for (part, at) in parts.iter_mut().zip(1..) {
                    joining.next();
                    let read = part.read_on(&mut joining);
                    if let Input::File(input) = &mut part.input {
                        input.rewind()?;
                    }
                    report.add_part(part.take_report(), at);
                    read.map_err(|error| of_part(error, at))?;
                }
                Ok(())
            }
        }
    }
}

impl fmt::Debug for Job<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Job").field("format", &self.format).field("reading", &self.reading).finish_non_exhaustive()
    }
}

/// Adds to an error the number of the joined job in which the error is.
fn of_part(error: ReadError, part: u16) -> ReadError {
    match error {
        ReadError::Job(mut diag) => {
            diag.place.get_or_insert_default().part = part;
            ReadError::Job(diag)
        }
        other => other,
    }
}

/// Number of bytes of a document that are read at once.
const DOCUMENT_BUFFER: usize = 128 << 10;

/// The units in the first event.
struct FirstUnits(Option<Units>);

impl Sink for FirstUnits {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        if let Event::Start(start) = &event {
            self.0 = Some(start.units);
        }
        Flow::Break(Stop::Enough)
    }
}

/// Fills in the first move of a tool change from the events after it.
struct Ahead<'s>(Hold<'s>);

impl Sink for Ahead<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        match event {
            Event::ToolChange(change) => flow(self.0.tool_change(change.clone(), place)),
            event => self.0.event(event, place),
        }
    }
}
