//! What is said on standard error. Nobody may hear it: a terminal that is full or gone fails no work.

use std::io::{Write, stderr};

use postform::internals::terminal::escaped_lines;

/// Says a report as it stands.
pub fn say(report: &str) {
    _ = stderr().write_all(report.as_bytes());
}

/// Says a message on lines of its own. What it quotes from files and arguments can't steer the terminal.
pub fn message(text: &str) {
    say(&format!("{}\n", escaped_lines(text)));
}

/// A message: the system gives no thread.
pub fn no_thread(error: &std::io::Error) -> String {
    format!("error: no thread can be started: {error}\n  help: end other programs, or raise the limit (`ulimit -u`)")
}
