//! What is said about a file besides its events: who wrote it, warnings, facts.

use super::dialect::{Dialect, Sense};
use crate::diag::{Code, Diag, Location};
use crate::remarks::Remarks;
use crate::toolpath::Place;

/// What was noticed besides the events.
#[derive(Debug, Default)]
pub struct Report {
    /// Who wrote the file.
    pub dialect: Option<Dialect>,
    /// Why that was taken to be so.
    pub why: String,
    /// Warnings: each kind once, with a count.
    pub warnings: Vec<Diag>,
    /// What the file says of itself: coordinate systems, names of tool paths.
    pub facts: Vec<String>,
    /// Majors that nothing is done for, with their first line and count.
    unknown: Vec<(String, u64, u64)>,
}

/// Most facts, warnings and unknown words that are kept.
const MOST_FACTS: usize = 100;

impl Report {
    /// Adds what another reader noticed.
    pub(crate) fn add(&mut self, remarks: Remarks) {
        self.facts.extend(remarks.facts);
        self.warnings.extend(remarks.warnings);
    }
}

/// The report, and the place in the file that is read.
pub(super) struct Notes<'r> {
    pub report: &'r mut Report,
    pub place: Place,
    /// The caller named the dialect.
    pub said: bool,
}

impl<'r> Notes<'r> {
    /// For a file whose writer the caller may know.
    pub fn new(report: &'r mut Report, said: Option<Dialect>) -> Self {
        report.dialect = said;
        if said.is_some() {
            report.why = "as said".into();
        }
        Notes { report, place: Place::default(), said: said.is_some() }
    }

    /// The dialect: as said or seen, else GENER's.
    pub fn dialect(&self) -> Dialect {
        self.report.dialect.unwrap_or(Dialect::Gener)
    }

    /// Which way circles turn in files of the system that the caller named. GENER's own are left-handed, but only a file
    /// that the caller named as GENER's is taken for one.
    #[inline]
    pub fn said_sense(&self) -> Option<Sense> {
        match self.report.dialect.filter(|_| self.said)? {
            Dialect::Gener => Some(Sense::LeftHand),
            dialect => dialect.sense(),
        }
    }

    /// Who wrote the file shows in its first lines, unless the caller named it.
    pub fn look_at<'l>(&mut self, lines: impl Iterator<Item = &'l [u8]>) {
        if !self.said
            && let Some((dialect, line, mark)) = Dialect::of_head(lines)
        {
            self.report.dialect = Some(dialect);
            self.report.why = format!("line {line} has `{mark}`");
        }
    }

    /// A warning, once.
    pub fn warn(&mut self, code: Code, message: impl Into<String>, help: &str) {
        self.warn_at(self.place, code, message, help);
    }

    /// A warning about an earlier place, once.
    pub fn warn_at(&mut self, place: Place, code: Code, message: impl Into<String>, help: &str) {
        let message = message.into();
        let warnings = &mut self.report.warnings;
        if warnings.len() < MOST_FACTS && !warnings.iter().any(|w| w.code == code && w.message == message) {
            warnings.push(Diag::new(code, message).help(help).place(place));
        }
    }

    /// Something that the file says of itself, once.
    pub fn fact(&mut self, fact: String) {
        if self.report.facts.len() < MOST_FACTS && !self.report.facts.contains(&fact) {
            self.report.facts.push(fact);
        }
    }

    /// A major word that nothing is done for.
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
            let message = format!("`{name}` is not known and nothing is done for it{times}");
            let diag = Diag::new(Code::PL003, message).help("look whether it moves or switches anything");
            self.report.warnings.push(diag.place(Location::line(line)));
        }
    }
}
