//! Results of reading a file, besides its events: its dialect, warnings and facts.

use super::dialect::{Dialect, Sense};
use crate::diag::{Code, Diag, Location};
use crate::remarks::Remarks;
use crate::toolpath::Place;

/// Results of reading, besides the events.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// The system that wrote the file.
    pub dialect: Option<Dialect>,
    /// Reason for this choice.
    pub why: String,
    /// Warnings; each appears once.
    pub warnings: Vec<Diag>,
    /// Facts in the file: coordinate systems, names of tool paths.
    pub facts: Vec<String>,
    /// Major words that were not handled, with their first line and count.
    unknown: Vec<(String, u64, u64)>,
}

/// Maximum number of facts, of warnings and of unknown words.
const MOST_FACTS: usize = 100;

impl Report {
    /// Adds the results of another reader.
    pub(crate) fn add(&mut self, remarks: Remarks) {
        self.facts.extend(remarks.facts);
        self.warnings.extend(remarks.warnings);
    }

    /// Adds the warnings and facts of a job among joined jobs, which is counted from 1.
    pub(crate) fn add_part(&mut self, other: Report, part: u16) {
        self.facts.extend(other.facts);
        self.warnings.extend(other.warnings.into_iter().map(|mut warning| {
            warning.place.get_or_insert_default().part = part;
            warning
        }));
    }
}

/// The report, and the current location in the file.
pub(super) struct Notes<'r> {
    pub report: &'r mut Report,
    pub place: Place,
    /// The caller named the dialect.
    pub said: bool,
}

impl<'r> Notes<'r> {
    /// Creates the notes. `said`: the dialect, if the caller named it.
    pub fn new(report: &'r mut Report, said: Option<Dialect>) -> Self {
        report.dialect = said;
        if said.is_some() {
            report.why = "as given".into();
        }
        Notes { report, place: Place::default(), said: said.is_some() }
    }

    /// The dialect: as named or recognised, else GENER.
    pub fn dialect(&self) -> Dialect {
        self.report.dialect.unwrap_or(Dialect::Gener)
    }

    /// Direction of circles in files of the system that the caller named. GENER's circles are left-handed, but a file counts as
    /// GENER's in this respect only if the caller named GENER.
    #[inline]
    pub fn said_sense(&self) -> Option<Sense> {
        match self.report.dialect.filter(|_| self.said)? {
            Dialect::Gener => Some(Sense::LeftHand),
            dialect => dialect.sense(),
        }
    }

    /// Recognises the dialect from the first lines, unless the caller named it.
    pub fn look_at<'l>(&mut self, lines: impl Iterator<Item = &'l [u8]>) {
        if !self.said
            && let Some((dialect, line, mark)) = Dialect::of_head(lines)
        {
            self.report.dialect = Some(dialect);
            self.report.why = format!("line {line} has `{mark}`");
        }
    }

    /// Adds a warning, once.
    pub fn warn(&mut self, code: Code, message: impl Into<String>, help: &str) {
        self.warn_at(self.place, code, message, help);
    }

    /// Adds a warning at an earlier location, once.
    pub fn warn_at(&mut self, place: Place, code: Code, message: impl Into<String>, help: &str) {
        let message = message.into();
        let warnings = &mut self.report.warnings;
        if warnings.len() < MOST_FACTS && !warnings.iter().any(|w| w.code == code && w.message == message) {
            warnings.push(Diag::new(code, message).help(help).place(place));
        }
    }

    /// Adds a fact, once.
    pub fn fact(&mut self, fact: String) {
        if self.report.facts.len() < MOST_FACTS && !self.report.facts.contains(&fact) {
            self.report.facts.push(fact);
        }
    }

    /// Counts a major word that was not handled.
    pub fn unknown(&mut self, name: &str) {
        let unknown = &mut self.report.unknown;
        match unknown.iter().position(|(known, _, _)| known == name) {
            Some(at) => unknown[at].2 += 1,
            None if unknown.len() < MOST_FACTS => unknown.push((name.to_owned(), self.place.line, 1)),
            None => {}
        }
    }

    /// Warns of each unknown major word once, with its count.
    pub fn tell_unknown(&mut self) {
        for (name, line, count) in std::mem::take(&mut self.report.unknown) {
            let times = if count == 1 { String::new() } else { format!(", {count} times") };
            let message = format!("`{name}` is unknown and is ignored{times}");
            let diag = Diag::new(Code::PL003, message).help("check whether it moves or switches anything");
            self.report.warnings.push(diag.place(Location::line(line)));
        }
    }
}
