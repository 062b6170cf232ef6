//! Errors of rendering: message, word of the form, and help. The location of the event is added at the end.

use crate::diag::{Code, Diag};
use crate::span::Span;

/// The result of a step of rendering.
pub type Done<T = ()> = Result<T, Box<Diag>>;

/// An error without a location in the form.
#[cold]
pub fn fault<T>(code: Code, message: impl Into<String>, help: impl Into<String>) -> Done<T> {
    Err(Box::new(Diag::new(code, message).help(help)))
}

/// An error at a word of the form.
#[cold]
pub fn fault_at<T>(code: Code, message: impl Into<String>, help: impl Into<String>, form: Option<Span>) -> Done<T> {
    let mut diag = Diag::new(code, message).help(help);
    if let Some(span) = form {
        diag = diag.at(span, "printed from here");
    }
    Err(Box::new(diag))
}
