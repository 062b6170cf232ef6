//! A difference or hazard, from three sides: the job, the form, the program.

use crate::diag::{Code, Diag, Location};
use crate::render::TraceLine;
use crate::span::Span;
use crate::terminal::escaped_lines;
use crate::toolpath;

/// A difference or hazard: where in the job and in the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Row in the table of codes.
    pub code: Code,
    /// What differs, with both values.
    pub message: String,
    /// What to look at.
    pub help: &'static str,
    /// The job's item, where one is concerned.
    pub place: Option<toolpath::Place>,
    /// The program's line, from 1; 0 where it has none.
    pub line: u64,
    /// The line of the program as written.
    pub block: String,
    /// The form line that printed the block, where that was traced.
    pub form: Option<Span>,
    /// How often the difference was found, this time included: what follows from one cause is one finding.
    pub times: u64,
}

impl Finding {
    /// For people: with the item of the job, the block, and the form line. `program`: what the program is called.
    pub fn diag(&self, program: &str) -> Diag {
        let mut location = self.place.map(Location::from).unwrap_or_default();
        location.program_line = Some(self.line).filter(|line| *line > 0);
        let mut diag = Diag::new(self.code, &self.message).help(self.help).place(location);
        if self.times > 1 {
            diag.message += &format!(" ({} times)", self.times);
        }
        // the block on a line of its own, and whole
        if self.line > 0 {
            diag.message += &escaped_lines(&format!("\n{program}, line {}: {}", self.line, self.block));
        }
        match self.form {
            Some(span) => diag.at(span, "prints this block"),
            None => diag,
        }
    }

    /// Says which form line printed the block, and by which item of the job where that is not known.
    pub(crate) fn locate(&mut self, origin: TraceLine) {
        self.form = origin.form;
        self.place.get_or_insert(origin.place);
    }
}
