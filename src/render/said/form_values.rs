//! What the form set by words of its own, in place of the job's.

use super::conditions::Conditions;
use crate::span::Span;

/// What the form set by words of its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct Own {
    /// The code of coolant that was printed while the job gave no coolant.
    pub(super) cool: Option<f64>,
    /// The speed that the tool change printed, and the job's, in whose place it stands.
    pub(super) speed: Option<(f64, f64)>,
    /// Conditions that a line turned on otherwise than the job does, since the last look at them.
    pub(super) typed: Conditions,
    /// The line that did so last.
    pub(super) line: Option<Span>,
}
