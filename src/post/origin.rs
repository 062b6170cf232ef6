//! Finds the form line and the job item that printed a block.

use super::Post;
use super::options::Options;
use super::reading::read_for;
use crate::error::Error;
use crate::job::Job;
use crate::render::{Renderer, TraceLine};
use crate::toolpath::{Event, Flow, Place, Sink, Stop};

impl Post {
    /// Finds what printed the given lines of the program, by printing the program again. `lines` are counted from 1. A result of
    /// `None` means that the program does not have the line. The job is read only as far as needed.
    ///
    /// # Errors
    /// The job can't be read, or an option is invalid.
    #[doc(hidden)]
    pub fn origins(&self, mut job: Job<'_>, options: &Options, lines: &[u64]) -> Result<Vec<Option<TraceLine>>, Error> {
        let options = Options { trace: true, ..options.clone() };
        let mut for_renderer = options.for_renderer(&self.0.program.settings)?;
        for_renderer.survey = self.survey(&mut job, &options)?;
        let renderer = Renderer::new(&self.0.program, for_renderer);
        let found = vec![None; lines.len()];
        let mut finder = Finder { renderer, lines, missing: lines.len(), found };
        // an event that can't be printed ends the search, and the origins found so far are returned
        let _ = read_for(Some(&self.0.program.settings), &mut job, &mut finder);
        finder.look();
        Ok(finder.found)
    }
}

struct Finder<'p> {
    renderer: Renderer<'p>,
    lines: &'p [u64],
    missing: usize,
    found: Vec<Option<TraceLine>>,
}

impl Finder<'_> {
    fn look(&mut self) {
        self.renderer.text().clear();
        let Some(printed) = self.renderer.trace() else { return };
        for traced in printed.drain(..) {
            for (line, found) in self.lines.iter().zip(&mut self.found) {
                if *line == traced.line && found.is_none() {
                    *found = Some(traced);
                    self.missing -= 1;
                }
            }
        }
    }
}

impl Sink for Finder<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.renderer.event(event, place)?;
        self.look();
        if self.missing == 0 { Flow::Break(Stop::Enough) } else { Flow::Continue(()) }
    }
}
