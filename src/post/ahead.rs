//! Jobs that are read twice, because the form says what lies ahead in them.

use std::sync::Arc;

use super::Post;
use super::options::Options;
use crate::error::Error;
use crate::job::Job;
use crate::render::survey_terms;
use crate::survey::{Survey, Surveyor};

impl Post {
    /// Does the form say what only the end of a job tells: tools, operations or extents, as `@for tool` and `[hmin]`? Then a job
    /// is read twice; one that comes as a stream is held in memory.
    pub fn reads_ahead(&self) -> bool {
        self.0.program.reads_ahead()
    }

    /// Is a job read twice, be it for the next tool, which some jobs say in their head?
    pub fn may_read_twice(&self) -> bool {
        self.reads_ahead() || self.0.program.asks_tools_ahead()
    }

    /// What lies ahead in a job, if the form says any of it.
    pub(super) fn survey(&self, job: &mut Job<'_>, options: &Options) -> Result<Option<Arc<Survey>>, Error> {
        let (all, tools) = (self.reads_ahead(), self.0.program.asks_tools_ahead());
        if options.one_pass && all {
            let message = "the form says what lies ahead in the job, and the job is to be read once";
            return Err(Error::usage(message));
        }
        if options.one_pass || !all && !tools {
            return Ok(None);
        }
        job.hold()?;
        let (read, survey) = self.surveyed(job, options);
        read.map(|()| Some(Arc::new(survey)))
    }

    /// As much as can be said of a job that may not be whole.
    pub(super) fn surveyed(&self, job: &mut Job<'_>, options: &Options) -> (Result<(), Error>, Survey) {
        let terms = survey_terms(&self.0.program, options.sink_as_printed);
        let mut surveyor = Surveyor::new(terms);
        let read = job.again().read(&mut surveyor);
        (read, surveyor.finish())
    }
}
