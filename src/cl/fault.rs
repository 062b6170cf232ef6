//! Errors in statements.

use crate::diag::{Code, Diag};
use crate::toolpath::Stop;

/// Result of a statement: success, or the reason to stop.
pub(super) type Done<T = ()> = Result<T, Stop>;

/// The error for a statement. The reader adds the location.
pub(super) fn fault<T>(code: Code, message: impl Into<String>, help: impl Into<String>) -> Done<T> {
    Err(Diag::new(code, message).help(help).into())
}
