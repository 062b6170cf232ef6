//! Messages on standard error. Errors of the terminal are ignored.

use std::cell::RefCell;
use std::io::{Write, stderr};

use postform::internals::terminal::escaped_lines;

thread_local! {
    /// The messages of this thread that are kept; `None`: messages are written at once.
    static KEPT: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Writes a report unchanged.
pub fn say(report: &str) {
    KEPT.with_borrow_mut(|kept| match kept {
        Some(text) => text.push_str(report),
        None => _ = stderr().write_all(report.as_bytes()),
    });
}

/// Whether messages of this thread are kept instead of written.
pub fn is_kept() -> bool {
    KEPT.with_borrow(Option::is_some)
}

/// Runs some work and returns the messages of this thread instead of writing them. In this way, the messages of several
/// threads are not mixed.
pub fn kept<R>(work: impl FnOnce() -> R) -> (R, String) {
    KEPT.set(Some(String::new()));
    let done = work();
    (done, KEPT.take().unwrap_or_default())
}

/// Writes a message on separate lines. Control characters in quoted text are escaped.
pub fn message(text: &str) {
    say(&format!("{}\n", escaped_lines(text)));
}

/// The message that no thread is available.
pub fn no_thread(error: &std::io::Error) -> String {
    format!("error: can't start a thread: {error}\n  help: end other programs, or raise the limit (`ulimit -u`)")
}
