//! Checks the order of events. A wrong order is always an error in the code that pushes events, and not in a job.

use super::event::Event;
use crate::diag::{Code, Diag};

/// The state of a stream of events. This state determines which events may follow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Outside a cycle.
    #[default]
    Path,
    /// In a cycle. Any event except a hole ends the cycle.
    Cycle,
    /// After the end of the job.
    End,
}

impl Order {
    /// Checks the next event.
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

/// The error for events that no reader may push. The cause is an error in postform itself.
///
/// # Errors
/// Always fails.
#[cold]
pub fn impossible<T>(what: &str) -> Result<T, Box<Diag>> {
    let help = "this is an error in postform, not in the job: please report it, if possible with the job";
    Err(Box::new(Diag::new(Code::PX001, what).help(help)))
}
