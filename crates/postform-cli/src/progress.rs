//! Progress of long work, on a terminal only.

use std::io::{IsTerminal, stderr};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::say::is_kept;

/// Work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);
/// How often the line is drawn in a second.
const DRAWN: u8 = 4;

/// A line on standard error that says how far the work is. It is taken away at the end, so that messages begin at their margin.
pub struct Progress {
    bar: ProgressBar,
    /// When the line is shown; `None`: it is, or never will be.
    begins: Mutex<Option<Instant>>,
}

impl Progress {
    /// Work of unknown length begins, which counts program lines.
    pub fn new() -> Progress {
        Progress::with(ProgressBar::hidden(), "{human_pos} lines")
    }

    /// Work on so many items begins.
    pub fn of(count: u64) -> Progress {
        let bar = ProgressBar::hidden();
        bar.set_length(count);
        Progress::with(bar, "{bar:40} {human_pos} of {human_len}, {eta} left")
    }

    fn with(bar: ProgressBar, template: &str) -> Progress {
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        // work of many shows how far all of it is
        let begins = (stderr().is_terminal() && !is_kept()).then(|| Instant::now() + PATIENCE);
        Progress { bar, begins: Mutex::new(begins) }
    }

    /// Shows how many program lines are done.
    pub fn lines(&self, lines: u64) {
        self.show();
        self.bar.set_position(lines);
    }

    /// One more item is done.
    pub fn one(&self) {
        self.show();
        self.bar.inc(1);
    }

    /// Does some work that writes to the terminal, with the line taken away.
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
