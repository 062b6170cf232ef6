//! Values that words of the form set in place of the job's values.

use super::conditions::Conditions;
use crate::span::Span;

/// Values that words of the form set in place of the job's values.
#[derive(Clone, Copy, Debug, Default)]
pub struct Own {
    /// Coolant code that was printed while the job set no coolant.
    pub(super) cool: Option<f64>,
    /// The speed that the tool change printed, and the job's speed that the printed speed replaces.
    pub(super) speed: Option<(f64, f64)>,
    /// Conditions that lines of the form have set to other values than the job since the last check.
    pub(super) typed: Conditions,
    /// The last line that set a condition to another value than the job.
    pub(super) line: Option<Span>,
}
