//! The source map of a program, in both directions: program line to form line and job item, and back.

use crate::render::TraceLine;
use crate::span::Span;

/// The origin of every line of a program.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    lines: Vec<TraceLine>,
}

impl Trace {
    /// A map from lines in the order of the program, as the renderer produces them.
    pub fn new(lines: Vec<TraceLine>) -> Trace {
        Trace { lines }
    }

    /// The origin of a program line; lines are numbered from 1.
    pub fn line(&self, number: u64) -> Option<&TraceLine> {
        let at = self.lines.binary_search_by_key(&number, |line| line.line).ok()?;
        Some(&self.lines[at])
    }

    /// The program lines that come from a location in the form: each program line whose form line overlaps the span.
    pub fn printed_by_form(&self, place: Span) -> impl Iterator<Item = u64> {
        let overlaps = move |span: Span| span.file == place.file && span.start < place.end && place.start < span.end;
        self.lines.iter().filter(move |line| line.form.is_some_and(overlaps)).map(|line| line.line)
    }
}
