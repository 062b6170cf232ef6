//! Progress of long operations, on a terminal only.

use std::io::{IsTerminal, stderr};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::say::is_kept;

/// Operations shorter than this time show no progress.
const PATIENCE: Duration = Duration::from_secs(1);
/// Number of updates of the line per second.
const DRAWN: u8 = 4;

/// A line on standard error with the progress of the work. The line is removed at the end, so that messages begin at
/// the left margin.
pub struct Progress {
    bar: ProgressBar,
    /// The time from which the line is shown; `None`: the line is already shown, or is never shown.
    begins: Mutex<Option<Instant>>,
}

impl Progress {
    /// Begins work of unknown length, counted in program lines.
    pub fn new() -> Progress {
        Progress::with(ProgressBar::hidden(), "{human_pos} lines")
    }

    /// Begins work on this number of items.
    pub fn of(count: u64) -> Progress {
        let bar = ProgressBar::hidden();
        bar.set_length(count);
        Progress::with(bar, "{bar:40} {human_pos} of {human_len}, {eta} left")
    }

    fn with(bar: ProgressBar, template: &str) -> Progress {
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        // a thread that works on one of many items shows no line of its own, because the line of the whole work is
        // shown
        let begins = (stderr().is_terminal() && !is_kept()).then(|| Instant::now() + PATIENCE);
        Progress { bar, begins: Mutex::new(begins) }
    }

    /// Shows the number of finished program lines.
    pub fn lines(&self, lines: u64) {
        self.show();
        self.bar.set_position(lines);
    }

    /// Counts one more finished item.
    pub fn one(&self) {
        self.show();
        self.bar.inc(1);
    }

    /// Removes the line during work that writes to the terminal.
    pub fn hidden<R>(&self, work: impl FnOnce() -> R) -> R {
        self.bar.suspend(work)
    }

    fn show(&self) {
        let Ok(mut begins) = self.begins.try_lock() else { return };
        if begins.is_some_and(|begins| Instant::now() >= begins) {
            *begins = None;
            self.bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(DRAWN));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
