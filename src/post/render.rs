//! Jobs printed.

use std::io::{self, Write};

use super::Post;
use super::growth::Growth;
use super::options::Options;
use super::program::{Part, Program, Rendered};
use crate::diag::{Code, Diag};
use crate::error::{Error, ErrorKind};
use crate::job::Job;
use crate::render::Renderer;
use crate::toolpath::{Event, Flow, Place, Sink, Stop, flow};

/// How much text waits before it is passed on.
const CHUNK: usize = 64 * 1024;

impl Post {
    /// Prints a job: the whole program, or nothing.
    ///
    /// # Errors
    /// The job can't be read or is wrong, or asks for what the form can't print.
    pub fn render(&self, job: Job<'_>, options: &Options) -> Result<Program, Error> {
        let (mut text, mut trace) = (Vec::new(), Vec::new());
        let rendered = self.render_parts(job, options, &mut |part| {
            text.extend_from_slice(part.text);
            trace.extend_from_slice(part.trace);
            Ok(())
        })?;
        let text = String::from_utf8(text).map_err(|error| Error::from(fault(&error.to_string())))?;
        Ok(Program { text, rendered, trace })
    }

    /// Prints a job as it is read, in memory that does not grow with it.
    ///
    /// # Errors
    /// As [`Post::render`], or the output fails. What was written is then a part of a program: throw it away.
    pub fn render_to(&self, job: Job<'_>, options: &Options, out: &mut impl Write) -> Result<Rendered, Error> {
        self.render_parts(job, options, &mut |part| out.write_all(part.text))
    }

    /// Prints a job as it is read, with its source map. `take` gets the parts in their order, some 64 KB each.
    ///
    /// # Errors
    /// As [`Post::render`], or `take` fails. What it got is then a part of a program: throw it away.
    pub fn render_parts(
        &self,
        mut job: Job<'_>,
        options: &Options,
        take: &mut dyn FnMut(Part<'_>) -> io::Result<()>,
    ) -> Result<Rendered, Error> {
        let mut printer = Printer {
            renderer: Renderer::new(&self.0.program, options.for_renderer()?),
            growth: Growth { read: job.bytes_read().filter(|_| !options.huge), printed: 0 },
            take,
            failure: None,
        };
        let mut read = job.read(&mut printer);
        if read.is_ok() && !printer.renderer.is_over() {
            read = Err(Error::usage("the events stop before the end of the job: push `Event::Finish` last"));
        }
        if read.is_ok() {
            printer.drain();
        }
        if let Some(error) = printer.failure {
            read = Err(Error::of_io(ErrorKind::Output, error));
        }
        let mut notes = job.take_report().warnings;
        notes.extend_from_slice(printer.renderer.notes());
        match read {
            Ok(()) => Ok(Rendered { notes, lines: printer.renderer.lines() }),
            Err(error) => Err(error.after(notes, self.files())),
        }
    }
}

fn fault(what: &str) -> Box<Diag> {
    Box::new(Diag::new(Code::PX001, what).help("this is a fault of postform: please report it"))
}

/// A sink between reader and output: prints, and passes text on as it comes.
struct Printer<'p, 't> {
    renderer: Renderer<'p>,
    growth: Growth,
    take: &'t mut dyn FnMut(Part<'_>) -> io::Result<()>,
    failure: Option<io::Error>,
}

impl Printer<'_, '_> {
    /// Passes on what waits.
    fn drain(&mut self) {
        let lines = self.renderer.lines();
        let mut trace = self.renderer.trace().map(std::mem::take).unwrap_or_default();
        let text = self.renderer.text();
        if let Err(error) = (self.take)(Part { text, trace: &trace, lines }) {
            self.failure = Some(error);
        }
        text.clear();
        trace.clear();
        if let Some(kept) = self.renderer.trace() {
            *kept = trace; // so that a part of a source map allocates nothing
        }
    }
}

impl Sink for Printer<'_, '_> {
    #[inline]
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.renderer.event(event, place)?;
        let length = self.renderer.text().len();
        if length < CHUNK {
            return Flow::Continue(());
        }
        flow(self.growth.print(length, place))?;
        self.drain();
        match &self.failure {
            Some(_) => Flow::Break(Stop::Enough),
            None => Flow::Continue(()),
        }
    }
}
