//! Who takes events, and how it ends that.

use std::ops::ControlFlow;

use super::event::Event;
use super::place::Place;
use crate::diag::{Diag, Location};

/// Why a sink takes no more events.
#[derive(Debug)]
pub enum Stop {
    /// The sink has seen enough, which is no error.
    Enough,
    /// What is wrong with the event, or with what it asks for.
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
    /// The finding, if there is one, with the place where it was found unless it has one.
    pub(crate) fn placed(mut self, place: impl FnOnce() -> Location) -> Stop {
        if let Stop::Wrong(diag) = &mut self {
            diag.place.get_or_insert_with(place);
        }
        self
    }
}

/// What a sink answers: go on, or why not.
pub type Flow = ControlFlow<Stop>;

/// A result as a sink's answer.
#[inline]
pub fn flow<E: Into<Stop>>(done: Result<(), E>) -> Flow {
    match done {
        Ok(()) => ControlFlow::Continue(()),
        Err(stop) => ControlFlow::Break(stop.into()),
    }
}

/// Something that takes events: the renderer, a summary, a check.
pub trait Sink {
    /// Takes one event with its place in the input. After a break nothing may be pushed.
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow;

    /// Gives the sink one event as a reader does, so that `?` ends the reading where the sink breaks off.
    ///
    /// # Errors
    /// The sink takes no more events.
    #[inline]
    fn push(&mut self, event: Event<'_>, place: Place) -> Result<(), Stop> {
        match self.event(event, place) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(stop) => Err(stop),
        }
    }
}
