//! What a feed counts.

/// A feed as it was said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Feed {
    /// Lengths of the file a minute.
    Minute(f64),
    /// Lengths of the file a revolution.
    Revolution(f64),
}
