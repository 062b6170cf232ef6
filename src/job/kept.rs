//! Jobs whose events are kept in memory, so that they are parsed only once.

use std::sync::Arc;

use super::{Format, Input, Job, Reading};
use crate::cl::Report;
use crate::toolpath::{Event, Flow, Kept, Place, ReadError, Sink, Stop};

/// The events of a job, as its reader pushed them.
#[derive(Clone, Debug)]
pub struct KeptJob {
    pub(super) events: Arc<[(Kept, Place)]>,
    pub(super) report: Report,
    format: Format,
    reading: Reading,
}

impl KeptJob {
    /// Reads a job and keeps its events. Returns `None` if the job has more than `most` events, can't be read again, or can't
    /// be read to its end.
    pub fn of(job: &mut Job<'_>, most: usize) -> Option<KeptJob> {
        if job.is_stream() {
            return None;
        }
        let mut keeper = Keeper { events: Vec::new(), most };
        // a selection applies when the kept events are read
        let select = std::mem::take(&mut job.reading.select);
        let read = job.read(&mut keeper);
        job.reading.select = select;
        read.ok().filter(|()| keeper.events.len() <= most)?;
        let reading = job.reading.clone();
        Some(KeptJob { events: keeper.events.into(), report: job.take_report(), format: job.format, reading })
    }

    /// A job that pushes the kept events; its text is not read again.
    pub fn job(&self) -> Job<'static> {
        Job { reading: self.reading.clone(), ..Job::new(self.format, Input::Kept(Box::new(self.clone()))) }
    }

    /// Pushes the events.
    pub(super) fn read(&self, sink: &mut dyn Sink) -> Result<(), ReadError> {
        for (event, place) in &*self.events {
            sink.push(event.event(), *place)?;
        }
        Ok(())
    }
}

/// Keeps events until they are too many.
struct Keeper {
    events: Vec<(Kept, Place)>,
    most: usize,
}

impl Sink for Keeper {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.events.push((Kept::from(&event), place));
        if self.events.len() > self.most { Flow::Break(Stop::Enough) } else { Flow::Continue(()) }
    }
}
