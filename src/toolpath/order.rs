//! Checks the order of events. A wrong order is a fault of the code that pushes events, never of a job.

use super::event::Event;
use crate::diag::{Code, Diag};

/// State of a stream of events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Outside a cycle.
    #[default]
    Path,
    /// In a cycle, until an event other than a hole.
    Cycle,
    /// After the end.
    End,
}

impl Order {
    /// Takes the next event.
    ///
    /// # Errors
    /// A hole is outside a cycle, or an event comes after the end.
    #[inline]
    pub fn follow(&mut self, event: &Event<'_>) -> Result<(), Box<Diag>> {
        *self = match (*self, event) {
            (Order::End, _) => return impossible("an event after the end of the job"),
            (Order::Cycle, Event::Hole(_)) => Order::Cycle,
            (_, Event::Hole(_)) => return impossible("a hole outside a cycle"),
            (_, Event::CycleBegin(_)) => Order::Cycle,
            (_, Event::Finish) => Order::End,
            _ => Order::Path,
        };
        Ok(())
    }
}

/// An error for events that no reader pushes. This is an error of postform itself.
///
/// # Errors
/// Always fails.
#[cold]
pub fn impossible<T>(what: &str) -> Result<T, Box<Diag>> {
    let help = "this is an error in postform, not in the job: please report it, if possible with the job";
    Err(Box::new(Diag::new(Code::PX001, what).help(help)))
}
