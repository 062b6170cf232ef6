//! A difference or hazard, with its locations in the job, the form and the program.

use crate::diag::{Code, Diag, Location};
use crate::render::TraceLine;
use crate::span::Span;
use crate::terminal::escaped_lines;
use crate::toolpath;

/// A difference between job and program, or a hazard of the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Code of the finding.
    pub code: Code,
    /// The difference, with the value of the job and the value of the program.
    pub message: String,
    /// What to check or change.
    pub help: &'static str,
    /// The item of the job, if the finding concerns an item.
    pub place: Option<toolpath::Place>,
    /// The program's line, from 1; 0 if there is none.
    pub line: u64,
    /// The line of the program as written.
    pub block: String,
    /// The form line that printed the block, if this line was recorded (traced).
    pub form: Option<Span>,
    /// How often the difference was found. Later differences with the same cause are only counted.
    pub times: u64,
}

impl Finding {
    /// The finding as a message: with the item of the job, the block and the form line. `program`: name of the program.
    pub fn diag(&self, program: &str) -> Diag {
        let mut location = self.place.map(Location::from).unwrap_or_default();
        location.program_line = Some(self.line).filter(|line| *line > 0);
        let mut diag = Diag::new(self.code, &self.message).help(self.help).place(location);
        if self.times > 1 {
            diag.message += &format!(" ({} times)", self.times);
        }
        // the block is shown on its own line and in full
        if self.line > 0 {
            diag.message += &escaped_lines(&format!("\n{program}, line {}: {}", self.line, self.block));
        }
        match self.form {
            Some(span) => diag.at(span, "prints this block"),
            None => diag,
        }
    }

    /// Adds the form line that printed the block. Adds the item of the job if the finding has none.
    pub(crate) fn locate(&mut self, origin: TraceLine) {
        self.form = origin.form;
        self.place.get_or_insert(origin.place);
    }
}
