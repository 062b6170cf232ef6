//! Reads a job twice if the form needs values from the rest of the job.

use std::sync::Arc;

use super::Post;
use super::options::Options;
use super::reading::read_for;
use crate::compile::Asks;
use crate::error::Error;
use crate::job::Job;
use crate::render::survey_terms;
use crate::sema::{PropertyKind, PropertyValue};
use crate::survey::{Survey, Surveyor};

impl Post {
    /// Whether the form needs values that are known only at the end of a job: tools, operations or extents. Examples
    /// are `@for tool` and `[hmin]`. If the form needs such values, a job is read twice, and a job from a stream is
    /// kept in memory. Parts of the form that the properties in the options switch off are not considered.
    ///
    /// # Errors
    /// The form does not have one of the properties, or a property does not accept its value.
    #[doc(hidden)]
    pub fn reads_ahead(&self, options: &Options) -> Result<bool, Error> {
        Ok(self.asks(options)?.all)
    }

    /// Whether a job may be read twice, because the form needs the next tool or other values from the rest of the job.
    /// If the form needs only the next tool, a job that lists its tools in the head is read only once.
    ///
    /// # Errors
    /// The same as for [`Post::reads_ahead`].
    #[doc(hidden)]
    pub fn may_read_twice(&self, options: &Options) -> Result<bool, Error> {
        let Asks { all, tools } = self.asks(options)?;
        Ok(all || tools)
    }

    /// A property and a value with which a job is read only once, such as `header=no`; `None` if there is no such
    /// property.
    #[doc(hidden)]
    pub fn reads_once_with(&self) -> Option<String> {
        let settings = &self.0.program.settings;
        let values = settings.properties.iter().enumerate().flat_map(|(row, property)| {
            let values = match &property.kind {
                PropertyKind::YesNo => [false, true].map(PropertyValue::YesNo).to_vec(),
                PropertyKind::Choice(words) => words.iter().cloned().map(PropertyValue::Text).collect(),
                _ => Vec::new(),
            };
            values.into_iter().map(move |value| (row as u16, value))
        });
        let once = values.into_iter().find(|given| !self.0.program.asks_ahead(std::slice::from_ref(given)).all);
        once.map(|(row, value)| format!("{}={value}", settings.properties[usize::from(row)].name))
    }

    fn asks(&self, options: &Options) -> Result<Asks, Error> {
        Ok(self.0.program.asks_ahead(&options.fixed_properties(&self.0.program.settings)?))
    }

    /// Reads the whole job first if the form needs values from the rest of the job.
    pub(super) fn survey(&self, job: &mut Job<'_>, options: &Options) -> Result<Option<Arc<Survey>>, Error> {
        let Asks { all, tools } = self.asks(options)?;
        if options.one_pass && all {
            let message = "the form prints values from later in the job, but the job can be read only once";
            return Err(Error::usage(message));
        }
        if options.one_pass || !all && !tools {
            return Ok(None);
        }
        job.hold()?;
        let (read, survey) = self.surveyed(job, options, !all);
        read.map(|()| Some(Arc::new(survey)))
    }

    /// Reads a job as far as possible. The job may be incomplete.
    pub(super) fn surveyed(
        &self,
        job: &mut Job<'_>,
        options: &Options,
        only_order: bool,
    ) -> (Result<(), Error>, Survey) {
        let terms = survey_terms(&self.0.program, options.sink_as_printed, only_order, options.rates.clone());
        let mut surveyor = Surveyor::new(terms);
        let read = read_for(Some(&self.0.program.settings), &mut job.again(), &mut surveyor);
        (read, surveyor.finish())
    }
}
