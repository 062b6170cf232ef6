//! Feeds with their unit.

/// A feed as the file gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Feed {
    /// Per minute, in the file's units.
    Minute(f64),
    /// Per revolution, in the file's units.
    Revolution(f64),
}
