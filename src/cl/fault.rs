//! What is wrong with a statement.

use crate::diag::{Code, Diag};
use crate::toolpath::Stop;

/// What a statement comes to: done, or why nothing goes on.
pub(super) type Done<T = ()> = Result<T, Stop>;

/// A fault; the reader adds the place.
pub(super) fn fault<T>(code: Code, message: impl Into<String>, help: impl Into<String>) -> Done<T> {
    Err(Diag::new(code, message).help(help).into())
}
