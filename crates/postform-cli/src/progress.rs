//! Progress of long work, on a terminal only.

use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use super::say::say;

/// Work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);
/// How often the line changes.
const EVERY: Duration = Duration::from_millis(250);

/// A line on standard error that says how far the work is.
pub struct Progress {
    started: Instant,
    shown: Option<Instant>,
    enabled: bool,
}

impl Progress {
    /// Work begins.
    pub fn new() -> Progress {
        Progress { started: Instant::now(), shown: None, enabled: stderr().is_terminal() }
    }

    /// Shows how many program lines are done.
    pub fn lines(&mut self, lines: u64) {
        let now = Instant::now();
        let due = self.shown.map_or(self.started + PATIENCE, |shown| shown + EVERY);
        if self.enabled && now >= due {
            say(&format!("\r{lines} lines"));
            self.shown = Some(now);
        }
    }
}

impl Drop for Progress {
    /// The line is taken away, so that messages begin at their margin.
    fn drop(&mut self) {
        if self.shown.is_some() {
            say("\r\x1b[K");
        }
    }
}
