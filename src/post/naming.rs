//! The file name of a program, which is known before the program is printed.

use super::Post;
use super::options::Options;
use crate::error::Error;
use crate::job::Job;
use crate::render::file_name_of;
use crate::toolpath::{Event, Flow, Place, Sink, Start, Stop};

/// A sink that keeps the head of a job and then stops the reader.
#[derive(Default)]
struct Head(Option<Start>);

impl Sink for Head {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        if let Event::Start(start) = event {
            self.0 = Some(start.clone());
        }
        Flow::Break(Stop::Enough)
    }
}

impl Post {
    /// The file name of the program, and its number. The name depends on the form and on the head of the job; no more of the job is read.
    ///
    /// # Errors
    /// The job ends before its head is complete, or its head contains an error.
    #[doc(hidden)]
    pub fn file_name(&self, mut job: Job<'_>, options: &Options) -> Result<(String, Option<f64>), Error> {
        let mut head = Head::default();
        let read = job.read(&mut head);
        let Some(start) = head.0 else {
            let missing = || Error::usage("the events stop before the job begins: push `Event::Start` first");
            return Err(job.names(read.err().unwrap_or_else(missing)));
        };
        let number = options.program.map(f64::from).or(start.program);
        let options = options.for_renderer(&self.0.program.settings)?;
        Ok((file_name_of(&self.0.program, options, &start), number))
    }
}
