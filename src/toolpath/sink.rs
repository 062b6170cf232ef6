//! Sinks receive events and can stop the reader that pushes them.

use std::ops::ControlFlow;

use super::event::Event;
use super::place::Place;
use crate::diag::{Diag, Location};

/// The reason why a sink stops the reader.
#[derive(Debug)]
pub enum Stop {
    /// The sink needs no more events. Stopping early is not an error.
    Enough,
    /// The event is wrong, or it requests something that is not possible.
    Wrong(Box<Diag>),
}

impl From<Box<Diag>> for Stop {
    fn from(diag: Box<Diag>) -> Stop {
        Stop::Wrong(diag)
    }
}

impl From<Diag> for Stop {
    fn from(diag: Diag) -> Stop {
        Stop::Wrong(Box::new(diag))
    }
}

impl Stop {
    /// Adds a location to a finding that has no location.
    pub(crate) fn placed(mut self, place: impl FnOnce() -> Location) -> Stop {
        if let Stop::Wrong(diag) = &mut self {
            diag.place.get_or_insert_with(|| Box::new(place()));
        }
        self
    }
}

/// The result of a sink: continue, or the reason to stop.
pub type Flow = ControlFlow<Stop>;

/// Converts a result to the result of a sink.
#[inline]
pub fn flow<E: Into<Stop>>(done: Result<(), E>) -> Flow {
    match done {
        Ok(()) => ControlFlow::Continue(()),
        Err(stop) => ControlFlow::Break(stop.into()),
    }
}

/// A receiver of events, such as the renderer, a summary or a check.
pub trait Sink {
    /// Processes one event with its location in the input. After a break, no more events may be pushed.
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow;

    /// Passes one event to the sink. The result is a `Result`, so `?` ends reading when the sink stops.
    ///
    /// # Errors
    /// The sink stops the reader.
    #[inline]
    fn push(&mut self, event: Event<'_>, place: Place) -> Result<(), Stop> {
        match self.event(event, place) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(stop) => Err(stop),
        }
    }
}
