//! Messages on standard error. A terminal that is full or gone fails no work.

use std::cell::RefCell;
use std::io::{Write, stderr};

use postform::internals::terminal::escaped_lines;

thread_local! {
    /// The messages of this thread while they are kept.
    static KEPT: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Writes a report as it is.
pub fn say(report: &str) {
    KEPT.with_borrow_mut(|kept| match kept {
        Some(text) => text.push_str(report),
        None => _ = stderr().write_all(report.as_bytes()),
    });
}

/// Are messages of this thread kept?
pub fn is_kept() -> bool {
    KEPT.with_borrow(Option::is_some)
}

/// Does some work and returns the messages of this thread in place of writing them, so that those of several threads stay apart.
pub fn kept<R>(work: impl FnOnce() -> R) -> (R, String) {
    KEPT.set(Some(String::new()));
    let done = work();
    (done, KEPT.take().unwrap_or_default())
}

/// Says a message on lines of its own. What it quotes from files and arguments can't steer the terminal.
pub fn message(text: &str) {
    say(&format!("{}\n", escaped_lines(text)));
}

/// A message: the system gives no thread.
pub fn no_thread(error: &std::io::Error) -> String {
    format!("error: no thread can be started: {error}\n  help: end other programs, or raise the limit (`ulimit -u`)")
}
