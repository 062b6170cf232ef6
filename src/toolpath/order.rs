//! The order of events: what can't come where it comes is a fault of whoever pushes events, never of a job.

use super::event::Event;
use crate::diag::{Code, Diag};

/// Where a stream of events stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Outside a cycle.
    #[default]
    Path,
    /// In a cycle, until anything but a hole comes.
    Cycle,
    /// After the end.
    End,
}

impl Order {
    /// Goes on by one event.
    ///
    /// # Errors
    /// A hole outside a cycle, an event after the end.
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

/// Something that no reader pushes: an error of postform itself.
///
/// # Errors
/// Always.
#[cold]
pub fn impossible<T>(what: &str) -> Result<T, Box<Diag>> {
    let help = "this is a fault of postform, not of the job: please report it, with the job if you may";
    Err(Box::new(Diag::new(Code::PX001, what).help(help)))
}
