//! Prints jobs.

use std::io::{self, Write};

use super::Post;
use super::growth::Growth;
use super::options::Options;
use super::program::{Part, Program, Rendered};
use super::reading::read_for;
use crate::diag::{Code, Diag};
use crate::error::{Error, ErrorKind};
use crate::job::Job;
use crate::render::Renderer;
use crate::toolpath::{Event, Flow, Kept, Place, Sink, Stop, flow};
use crate::verify::{Batch, Verdict};

/// Number of bytes of text after which the text is passed on.
const CHUNK: usize = 64 * 1024;
/// Number of events after which the events are passed on. These events and their text fit into the processor's cache.
const EVENTS: usize = 1024;

impl Post {
    /// Prints a job: either the whole program or nothing. Unless the options disable it, the program is also verified:
    /// it is simulated by the rules of its control and compared with the job. To verify the program, the job is read a
    /// second time, and a job from a stream is kept in memory.
    ///
    /// # Errors
    /// The job can't be read, contains an error, or requests something that the form can't print. The error is
    /// [`ErrorKind::Proof`] if the form names its control and the program differs from the job by the rules of this control.
    pub fn render(&self, job: Job<'_>, options: &Options) -> Result<Program, Error> {
        let program = self.tried(job, options)?;
        match &options.proof {
            Some(proof) => self.refused(&program.verdict, proof).map_or(Ok(program), Err),
            None => Ok(program),
        }
    }

    /// Like [`Post::render`], but also returns a program that differs from its job, with the verdict.
    ///
    /// # Errors
    /// The same as for [`Post::render`], except [`ErrorKind::Proof`].
    #[doc(hidden)]
    pub fn tried(&self, mut job: Job<'_>, options: &Options) -> Result<Program, Error> {
        if options.proof.is_some() {
            job.hold()?;
        }
        let mut program = self.printed(job.again(), options, &mut |_| {})?;
        if let Some(proof) = &options.proof {
            program.verdict = self.proven(job, &program.text, options, proof)?;
        }
        Ok(program)
    }

    /// Prints a job without verifying the program. `take` receives the text in parts while it is printed.
    ///
    /// # Errors
    /// The same as for [`Post::render`], except [`ErrorKind::Proof`].
    #[doc(hidden)]
    pub fn printed(&self, job: Job<'_>, options: &Options, take: &mut dyn FnMut(&[u8])) -> Result<Program, Error> {
        let (mut text, mut trace) = (Vec::new(), Vec::new());
        let rendered = self.render_parts(job, options, &mut |part| {
            text.extend_from_slice(part.text);
            trace.extend_from_slice(part.trace);
            take(part.text);
            Ok(())
        })?;
        let text = String::from_utf8(text).map_err(|error| Error::from(fault(&error.to_string())))?;
        Ok(Program { text, rendered, trace, verdict: Verdict::not_asked_for() })
    }

    /// Prints a job while the job is read. Memory use does not grow with the job. The program is not verified.
    ///
    /// # Errors
    /// The same as for [`Post::render`], or the output fails. After an error, the output is incomplete and must be
    /// deleted.
    pub fn render_to(&self, job: Job<'_>, options: &Options, out: &mut impl Write) -> Result<Rendered, Error> {
        self.render_parts(job, options, &mut |part| out.write_all(part.text))
    }

    /// Prints a job while the job is read, with its source map. `take` receives the parts of the program in their order, each
    /// about 64 KB long. The program is not verified.
    ///
    /// # Errors
    /// The same as for [`Post::render`], or `take` fails. After an error, the parts are incomplete and must be deleted.
    #[doc(hidden)]
    pub fn render_parts(
        &self,
        job: Job<'_>,
        options: &Options,
        take: &mut dyn FnMut(Part<'_>) -> io::Result<()>,
    ) -> Result<Rendered, Error> {
        self.print(job, options, take, None)
    }

    /// Like [`Post::render_parts`], and also passes on the data for a verification. `prove` receives events and text in
    /// their order, for [`Post::prove`] on another thread. `prove` returns a batch to be filled next, which may be
    /// empty or used before. `prove` returns `None` if no more data is needed.
    ///
    /// # Errors
    /// The same as for [`Post::render_parts`].
    #[doc(hidden)]
    pub fn render_beside(
        &self,
        job: Job<'_>,
        options: &Options,
        take: &mut dyn FnMut(Part<'_>) -> io::Result<()>,
        prove: &mut dyn FnMut(Batch) -> Option<Batch>,
    ) -> Result<Rendered, Error> {
        self.print(job, options, take, Some(prove))
    }

    fn print(
        &self,
        mut job: Job<'_>,
        options: &Options,
        take: &mut dyn FnMut(Part<'_>) -> io::Result<()>,
        prove: Option<&mut dyn FnMut(Batch) -> Option<Batch>>,
    ) -> Result<Rendered, Error> {
        let mut for_renderer = options.for_renderer(&self.0.program.settings)?;
        for_renderer.survey = self.survey(&mut job, options).map_err(|error| job.names(error))?;
        for_renderer.trace |= prove.is_some();
        let mut printer = Printer {
            renderer: Renderer::new(&self.0.program, for_renderer),
            growth: Growth { read: job.bytes_read().filter(|_| !options.huge), printed: 0 },
            take,
            traced: options.trace,
            batch: Batch::default(),
            prove,
            failure: None,
        };
        let mut read = read_for(Some(&self.0.program.settings), &mut job, &mut printer);
        if read.is_ok() && !printer.renderer.is_over() {
            read = Err(Error::usage("the events stop before the end of the job: push `Event::Finish` last"));
        }
        if read.is_ok() {
            printer.drain();
        }
        if let Some(error) = printer.failure {
            read = Err(Error::of_io(ErrorKind::Output, error));
        }
        let report = job.take_report();
        let (mut notes, left_out) = (report.warnings, report.left_out);
        notes.extend_from_slice(printer.renderer.notes());
        job.name_places(&mut notes);
        match read {
            Ok(()) => {
                let (lines, file_name) = (printer.renderer.lines(), printer.renderer.file_name());
                Ok(Rendered { notes, left_out, lines, file_name })
            }
            Err(error) => Err(job.names(error).after(notes, self.files())),
        }
    }
}

fn fault(what: &str) -> Box<Diag> {
    Box::new(Diag::new(Code::PX001, what).help("this is an error in postform: please report it"))
}

/// A sink between a reader and an output. The sink prints the events and passes the text on.
struct Printer<'p, 't, 's> {
    renderer: Renderer<'p>,
    growth: Growth,
    take: &'t mut dyn FnMut(Part<'_>) -> io::Result<()>,
    /// Whether the receiver of the parts needs the source map.
    traced: bool,
    /// The data to pass on: text, source map, and the events if the program is verified.
    batch: Batch,
    prove: Option<&'s mut dyn FnMut(Batch) -> Option<Batch>>,
    failure: Option<io::Error>,
}

impl Printer<'_, '_, '_> {
    /// Passes on the data that was collected.
    fn drain(&mut self) {
        let lines = self.renderer.lines();
        self.swap();
        let trace = if self.traced { &self.batch.trace[..] } else { &[] };
        if let Err(error) = (self.take)(Part { text: &self.batch.text, trace, lines }) {
            self.failure = Some(error);
        }
        if let Some(prove) = &mut self.prove {
            let next = prove(std::mem::take(&mut self.batch));
            if next.is_none() {
                self.prove = None;
            }
            self.batch = next.unwrap_or_default();
        }
        // the next part uses the same memory again
        self.batch.clear();
        self.swap();
    }

    /// Exchanges the output of the renderer and that of the batch.
    fn swap(&mut self) {
        std::mem::swap(self.renderer.text(), &mut self.batch.text);
        if let Some(trace) = self.renderer.trace() {
            std::mem::swap(trace, &mut self.batch.trace);
        }
    }

    /// Whether there is enough data to pass on.
    #[inline]
    fn is_full(&mut self) -> bool {
        self.renderer.text().len() >= CHUNK || self.batch.events.len() >= EVENTS
    }
}

impl Sink for Printer<'_, '_, '_> {
    #[inline]
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        if self.prove.is_some() {
            self.batch.events.push((Kept::from(&event), place));
        }
        self.renderer.event(event, place)?;
        if !self.is_full() {
            return Flow::Continue(());
        }
        flow(self.growth.print(self.renderer.text().len(), place))?;
        self.drain();
        match &self.failure {
            Some(_) => Flow::Break(Stop::Enough),
            None => Flow::Continue(()),
        }
    }
}
