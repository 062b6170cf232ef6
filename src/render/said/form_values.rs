//! Values that the form set by its own words instead of the job's.

use super::conditions::Conditions;
use crate::span::Span;

/// Values that the form set by its own words.
#[derive(Clone, Copy, Debug, Default)]
pub struct Own {
    /// Coolant code that was printed while the job set no coolant.
    pub(super) cool: Option<f64>,
    /// The speed that the tool change printed, and the job's speed that it replaces.
    pub(super) speed: Option<(f64, f64)>,
    /// Conditions that a line set differently from the job since the last check.
    pub(super) typed: Conditions,
    /// The last such line.
    pub(super) line: Option<Span>,
}
