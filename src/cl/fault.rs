//! What is wrong with a statement.

use crate::diag::{Code, Diag};

/// What a statement comes to: done, or what is wrong with it.
pub(super) type Done<T = ()> = Result<T, Box<Diag>>;

/// A fault; the reader adds the place.
pub(super) fn fault<T>(code: Code, message: impl Into<String>, help: impl Into<String>) -> Done<T> {
    Err(Box::new(Diag::new(code, message).help(help)))
}
