//! The results of reading a file except its events: its CAM system, warnings and facts.

use super::dialect::{Dialect, Sense};
use crate::diag::{Code, Diag, Location};
use crate::remarks::Remarks;
use crate::toolpath::Place;

/// The results of reading a job, except its events.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// The system that wrote the file.
    pub dialect: Option<Dialect>,
    /// Why this system was chosen.
    pub why: String,
    /// The warnings. Each warning appears only once.
    pub warnings: Vec<Diag>,
    /// Facts that the file contains, such as coordinate systems and names of tool paths.
    pub facts: Vec<String>,
    /// Number of operations that the selection of the reading leaves out.
    pub left_out: u64,
    /// Major words that are unknown.
    unknown: Vec<Unknown>,
}

/// A major word that is unknown.
#[derive(Clone, Debug)]
struct Unknown {
    name: String,
    /// A known word that is similar, as a sentence.
    near: Option<String>,
    /// The line of its first occurrence.
    line: u64,
    /// The number of occurrences.
    count: u64,
}

/// Maximum number of unknown words in the help of an error.
const MOST_IGNORED: usize = 3;

/// Maximum number of facts, and also of warnings and of unknown words.
const MOST_FACTS: usize = 100;

impl Report {
    /// Adds the facts and warnings of another reader.
    pub(crate) fn add(&mut self, remarks: Remarks) {
        self.facts.extend(remarks.facts);
        self.warnings.extend(remarks.warnings);
    }

    /// Adds the facts and warnings of one job among joined jobs. `part`: the number of this job, from 1.
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
    /// Whether the caller named the CAM system.
    pub said: bool,
    /// The line of the last tool change that was complete before it had a spindle speed, and the line that completed it.
    pub without_speed: Option<(u64, u64)>,
}

impl<'r> Notes<'r> {
    /// Begins the notes for a file. `said`: the CAM system, if the caller named it.
    pub fn new(report: &'r mut Report, said: Option<Dialect>) -> Self {
        report.dialect = said;
        if said.is_some() {
            report.why = "as given".into();
        }
        Notes { report, place: Place::default(), said: said.is_some(), without_speed: None }
    }

    /// The CAM system: named by the caller or recognised, otherwise GENER.
    pub fn dialect(&self) -> Dialect {
        self.report.dialect.unwrap_or(Dialect::Gener)
    }

    /// The direction of circles if the caller named the CAM system, otherwise `None`. If the caller named GENER,
    /// circles are left-handed. postform also reads files of an unknown system as GENER, but assumes no direction for
    /// the circles of these files.
    #[inline]
    pub fn said_sense(&self) -> Option<Sense> {
        match self.report.dialect.filter(|_| self.said)? {
            Dialect::Gener => Some(Sense::LeftHand),
            dialect => dialect.sense(),
        }
    }

    /// Recognises the CAM system from the first lines, unless the caller named it.
    pub fn look_at<'l>(&mut self, lines: impl Iterator<Item = &'l [u8]>) {
        if !self.said
            && let Some((dialect, line, mark)) = Dialect::of_head(lines)
        {
            self.report.dialect = Some(dialect);
            self.report.why = format!("line {line} has `{mark}`");
        }
    }

    /// Adds a warning. An equal warning is not added again.
    pub fn warn(&mut self, code: Code, message: impl Into<String>, help: &str) {
        self.warn_at(self.place, code, message, help);
    }

    /// Adds a warning at an earlier location. An equal warning is not added again.
    pub fn warn_at(&mut self, place: Place, code: Code, message: impl Into<String>, help: &str) {
        let message = message.into();
        let warnings = &mut self.report.warnings;
        if warnings.len() < MOST_FACTS && !warnings.iter().any(|w| w.code == code && w.message == message) {
            warnings.push(Diag::new(code, message).help(help).place(place));
        }
    }

    /// Adds a fact. An equal fact is not added again.
    pub fn fact(&mut self, fact: String) {
        if self.report.facts.len() < MOST_FACTS && !self.report.facts.contains(&fact) {
            self.report.facts.push(fact);
        }
    }

    /// Counts an unknown major word. `near`: a known word that is similar, as a sentence.
    pub fn unknown(&mut self, name: &str, near: impl FnOnce() -> Option<String>) {
        let unknown = &mut self.report.unknown;
        match unknown.iter().position(|known| known.name == name) {
            Some(at) => unknown[at].count += 1,
            None if unknown.len() < MOST_FACTS => {
                unknown.push(Unknown { name: name.to_owned(), near: near(), line: self.place.line, count: 1 });
            }
            None => {}
        }
    }

    /// Adds a warning for each unknown major word, with the number of its occurrences.
    pub fn tell_unknown(&mut self) {
        for Unknown { name, near, line, count } in std::mem::take(&mut self.report.unknown) {
            let times = if count == 1 { String::new() } else { format!(", {count} times") };
            let message = format!("`{name}` is unknown and is ignored{times}");
            let check = "check whether it moves or switches anything";
            let help = near.map_or(check.to_owned(), |near| format!("{near} Else {check}"));
            let diag = Diag::new(Code::PL003, message).help(help);
            self.report.warnings.push(diag.place(Location::line(line)));
        }
    }

    /// For an error in a tool change without a spindle speed: the line before which the speed is missing, as a line for the
    /// help of the error; otherwise empty.
    pub fn early(&self, diag: &Diag) -> String {
        let line = diag.place.as_ref().and_then(|place| place.line);
        match self.without_speed.filter(|(change, _)| line == Some(*change)) {
            Some((change, end)) => {
                format!(
                    "\nthe tool change of line {change} has no spindle speed, because SPINDL is not before line {end}"
                )
            }
            None => String::new(),
        }
    }

    /// The unknown major words before an error, as lines for its help; empty if there are none. An ignored word may be
    /// the cause of the error.
    pub fn ignored(&self) -> String {
        let one = |Unknown { name, near, line, .. }: &Unknown| {
            let near = near.as_ref().map_or(String::new(), |near| format!(": {near}"));
            format!("\n`{name}` in line {line} is unknown and was ignored{near}")
        };
        self.report.unknown.iter().take(MOST_IGNORED).map(one).collect()
    }
}
