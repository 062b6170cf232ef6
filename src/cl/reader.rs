//! Reading a CL file: state, statements, and what is held back until a tool change is complete.

use std::io::Read;

use super::arcs::{Heading, PendingArc};
use super::cycle::CycleState;
use super::dialect::{Dialect, Sense};
use super::lines::{LONGEST, Lines, text_statement, without_comment};
use super::machine::Feed;
use super::majors::{Major, major};
use super::paths::Assumed;
use super::texts::{Said, said};
use super::words::{Word, plain_goto, words};
use crate::diag::{Code, Diag};
use crate::toolpath::{
    Axes, Coolant, Event, First, Hold, Place, ReadError, Side, Sink, Spindle, SpindleTurn, Start, StopKind, Tool,
    ToolChange, Units,
};

/// What a caller may choose.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Who wrote the file; else it is told from its first lines.
    pub dialect: Option<Dialect>,
    /// Units of a file that does not say them.
    pub units: Option<Units>,
    /// The tool of a file that loads none, or each by its name.
    pub tool: Option<Assumed>,
}

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

/// Most facts that are kept.
const MOST_FACTS: usize = 100;
/// Most items between a tool change and its spindle.
const MOST_WAITING: usize = 4096;

pub(super) type Done<T = ()> = Result<T, Box<Diag>>;

/// What stands before a tool change is complete.
pub(super) enum Waiting {
    Rapid(Axes),
    /// A text statement: its word, its text.
    Words(&'static str, String),
    /// A code as it stands.
    Text(String),
}

/// The state of a file.
pub(super) struct Reader<'s> {
    hold: Hold<'s>,
    pub(super) options: Options,
    pub(super) report: &'s mut Report,
    pub(super) place: Place,
    /// The last major word, for lines of bare numbers.
    major: Major,
    pub(super) units: Option<Units>,
    pub(super) name: Option<String>,
    started: bool,
    ended: bool,
    /// Added to every position: TRANS, less ORIGIN.
    pub(super) offset: [f64; 3],
    pub(super) trans: [f64; 3],
    pub(super) origin: [f64; 3],
    /// Where the tool is; after a hole, where it was left.
    pub(super) position: Option<[f64; 3]>,
    /// The last point that was said, from which GODLTA counts.
    pub(super) point: Option<[f64; 3]>,
    /// The tool axis.
    pub(super) axis: [f64; 3],
    pub(super) heading: Option<Heading>,
    pub(super) sense: Option<Sense>,
    pub(super) arc: Option<PendingArc>,
    pub(super) direction: Option<[f64; 3]>,
    pub(super) feed: Option<Feed>,
    /// The feed that the sink has.
    pub(super) feed_known: Option<f64>,
    /// The next motion is a rapid.
    pub(super) rapid: bool,
    /// So is it after the end of a cycle, unless a feed comes first.
    pub(super) rapid_after_cycle: bool,
    pub(super) spindle: Spindle,
    /// The direction in which it turned last.
    pub(super) last_turn: Option<SpindleTurn>,
    /// It was said since the last motion, so perhaps for the tool that comes.
    pub(super) spindle_is_new: bool,
    pub(super) diameter: Option<f64>,
    /// The tool in use, as TOOL PATH names it.
    pub(super) tool_name: Option<String>,
    /// Tools that were named and not loaded.
    pub(super) not_loaded: Vec<String>,
    /// The greatest number that was loaded.
    pub(super) greatest_tool: f64,
    /// The first MSYS, and its line.
    pub(super) msys: Option<(Vec<Word>, u64)>,
    /// The coolant, which stays from tool to tool.
    pub(super) coolant: Option<Coolant>,
    /// A tool change that is not complete.
    pub(super) change: Option<(ToolChange, Place)>,
    pub(super) waiting: Vec<(Waiting, Place)>,
    /// An INSERT that may describe the tool that follows.
    pub(super) insert: Option<(String, Place)>,
    operations: u32,
    /// Compensation that the next motion turns on or off.
    pub(super) compensation: Option<Option<Side>>,
    pub(super) compensated: bool,
    pub(super) cycle: CycleState,
}

/// Reads a CL file and pushes its events. Memory does not grow with the file.
///
/// # Errors
/// What is wrong with the file, or with what the sink was asked to do, and where. Warnings up to there are in the report.
pub fn read_cl(input: impl Read, options: &Options, report: &mut Report, sink: &mut dyn Sink) -> Result<(), ReadError> {
    let mut lines = Lines::new(input);
    let mut reader = Reader::new(options.clone(), report, sink);
    let mut joined: Vec<u8> = Vec::new();
    let mut number = 0;
    let mut continues = false;
    while let Some(line) = lines.next().map_err(ReadError::Io)? {
        number += 1;
        if !continues {
            reader.place = Place { line: number, column: 1, ..Place::default() };
        }
        let line = if number == 1 { line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line) } else { line };
        let read = reader.line(line, &mut joined, &mut continues);
        read.map_err(|diag| reader.placed(diag))?;
    }
    let end = if continues { reader.cut_short() } else { reader.finish() };
    reader.tell_unknown();
    end.map_err(|diag| reader.placed(diag))
}

impl<'s> Reader<'s> {
    fn new(options: Options, report: &'s mut Report, sink: &'s mut dyn Sink) -> Self {
        report.dialect = options.dialect;
        if options.dialect.is_some() {
            report.why = "as said".into();
        }
        Reader {
            hold: Hold::new(sink),
            options,
            report,
            place: Place::default(),
            major: Major::None,
            units: None,
            name: None,
            started: false,
            ended: false,
            offset: [0.0; 3],
            trans: [0.0; 3],
            origin: [0.0; 3],
            position: None,
            point: None,
            axis: [0.0, 0.0, 1.0],
            heading: None,
            sense: None,
            arc: None,
            direction: None,
            feed: None,
            feed_known: None,
            rapid: false,
            rapid_after_cycle: false,
            spindle: Spindle::default(),
            last_turn: None,
            spindle_is_new: false,
            diameter: None,
            tool_name: None,
            not_loaded: Vec::new(),
            greatest_tool: 0.0,
            msys: None,
            coolant: None,
            change: None,
            waiting: Vec::new(),
            insert: None,
            operations: 0,
            compensation: None,
            compensated: false,
            cycle: CycleState::default(),
        }
    }

    /// A line of the file: a statement, a part of one, or a comment.
    #[inline]
    fn line(&mut self, line: &[u8], joined: &mut Vec<u8>, continues: &mut bool) -> Done {
        if !*continues
            && self.started
            && !self.ended
            && let Some((values, count)) = plain_goto(line)
        {
            self.major = Major::Goto;
            return self.goto(&values[..count]);
        }
        self.other_line(line, joined, continues)
    }

    fn other_line(&mut self, line: &[u8], joined: &mut Vec<u8>, continues: &mut bool) -> Done {
        if line.len() + joined.len() > LONGEST {
            return fault(Code::PL001, "a statement longer than 1 MB", "look whether this is a CL file");
        }
        let line = line.trim_ascii();
        if line.starts_with(b"\xff\xfe") || line.starts_with(b"\xfe\xff") {
            return fault(Code::PL001, "the file is UTF-16", "save it as plain text (ASCII or UTF-8)");
        }
        if line.contains(&b'\r') {
            return fault(
                Code::PL001,
                "the lines end with carriage returns alone",
                "save the file with LF or CRLF line ends",
            );
        }
        if self.ended && line == b"\x1a" {
            return Ok(()); // as DOS marks the end of a file
        }
        if !*continues {
            self.look_at(line);
            if line.starts_with(b"$$->") || line.starts_with(b"$$*") {
                return self.data_comment(line, joined, continues);
            }
            if let Some((word, text)) = text_statement(line) {
                let text = String::from_utf8_lossy(text.strip_suffix(b"~").unwrap_or(text)).into_owned();
                return if self.ended { Ok(()) } else { self.text(word, text) };
            }
        }
        let (part, goes_on) = without_comment(line);
        joined.extend_from_slice(part.strip_suffix(b"~").unwrap_or(part));
        *continues = goes_on || part.ends_with(b"~");
        if *continues {
            return Ok(());
        }
        let text = std::mem::take(joined);
        let read = if text.trim_ascii().is_empty() { Ok(()) } else { self.statement(&text) };
        *joined = text;
        joined.clear();
        read
    }

    /// Creo and CATIA carry data in comments.
    fn data_comment(&mut self, line: &[u8], joined: &mut Vec<u8>, continues: &mut bool) -> Done {
        let Some(data) = line.strip_prefix(b"$$->") else { return Ok(()) };
        let (part, goes_on) = without_comment(data);
        // the words behind `$$->` are information, which no statement may be made of
        joined.extend_from_slice(b"$DATA/");
        joined.extend_from_slice(part);
        *continues = goes_on;
        if goes_on {
            return Ok(());
        }
        let text = std::mem::take(joined);
        self.statement(&text)
    }

    /// Who wrote the file shows in its first lines.
    fn look_at(&mut self, line: &[u8]) {
        if self.report.dialect.is_none()
            && !self.started
            && let Some((dialect, mark)) = Dialect::of_line(line)
        {
            self.report.dialect = Some(dialect);
            self.report.why = format!("line {} has `{mark}`", self.place.line);
        }
    }

    /// The dialect: as said or seen, else GENER's.
    pub(super) fn dialect(&self) -> Dialect {
        self.report.dialect.unwrap_or(Dialect::Gener)
    }

    fn statement(&mut self, text: &[u8]) -> Done {
        if let Some(bad) = text.iter().find(|b| !b.is_ascii() || (b.is_ascii_control() && !b.is_ascii_whitespace())) {
            let message = format!("a byte that no statement has: {bad:#04x}");
            return fault(Code::PL001, message, "look whether this is a CL file");
        }
        let mut list = match words(text) {
            Ok(list) => list,
            Err(number) => return fault(Code::PL001, format!("`{number}` is no number"), "mend the number"),
        };
        // PTED numbers its records: `N27 , GOTO/..`
        let is_number = |w: &Word| w.name().and_then(|n| n.strip_prefix('N')).is_some_and(|n| n.parse::<u64>().is_ok());
        if list.len() > 1 && is_number(&list[0]) {
            list.remove(0);
        }
        let Some(first) = list.first() else { return Ok(()) };
        if self.ended {
            if first.is("FINI") {
                return Ok(()); // after END
            }
            return fault(Code::PL001, "a statement after FINI or END", "take it out, or the end before it");
        }
        let Some(name) = first.name().map(str::to_owned) else {
            // UG writes several points under one GOTO; some records go on without `$`
            return match self.major {
                Major::Goto => self.goto_words(&list),
                Major::Cutter | Major::Data => Ok(()),
                _ => fault(
                    Code::PL001,
                    "numbers that belong to no statement",
                    "put GOTO/ before them, or `$` at the end before",
                ),
            };
        };
        let name = unnumbered(&name).to_owned();
        list.remove(0);
        self.major = major(&name);
        self.run(self.major, &name, &list)
    }

    pub(super) fn note_unknown(&mut self, name: &str) {
        let unknown = &mut self.report.unknown;
        match unknown.iter().position(|(known, _, _)| known == name) {
            Some(at) => unknown[at].2 += 1,
            None if unknown.len() < MOST_FACTS => unknown.push((name.to_owned(), self.place.line, 1)),
            None => {}
        }
    }

    /// Each unknown major word once, with its count.
    fn tell_unknown(&mut self) {
        for (name, line, count) in std::mem::take(&mut self.report.unknown) {
            let times = if count == 1 { String::new() } else { format!(", {count} times") };
            let message = format!("`{name}` is not known and nothing is done for it{times}");
            let mut diag = Diag::new(Code::PL003, message).help("look whether it moves or switches anything");
            diag.place = Some(line.to_string());
            self.report.warnings.push(diag);
        }
    }

    /// A warning, once.
    pub(super) fn warn(&mut self, code: Code, message: impl Into<String>, help: &str) {
        let message = message.into();
        let warnings = &mut self.report.warnings;
        if warnings.len() < MOST_FACTS && !warnings.iter().any(|w| w.code == code && w.message == message) {
            let mut diag = Diag::new(code, message).help(help);
            diag.place = Some(self.place.to_string());
            warnings.push(diag);
        }
    }

    pub(super) fn fact(&mut self, fact: String) {
        if self.report.facts.len() < MOST_FACTS && !self.report.facts.contains(&fact) {
            self.report.facts.push(fact);
        }
    }

    /// What is printed where it stands, once the tool change before it is complete.
    pub(super) fn wait(&mut self, waiting: Waiting) -> Done {
        if self.started && self.change.is_none() {
            return self.push_waiting(&waiting, self.place);
        }
        if self.waiting.len() == MOST_WAITING {
            let help = "put the spindle before them, or look whether this is a CL file";
            return fault(Code::PL004, format!("more than {MOST_WAITING} items before the spindle of a tool"), help);
        }
        self.waiting.push((waiting, self.place));
        Ok(())
    }

    fn push_waiting(&mut self, waiting: &Waiting, place: Place) -> Done {
        match waiting {
            Waiting::Rapid(to) => self.between(Event::Rapid(*to), place),
            Waiting::Text(text) => self.between(Event::Text(text), place),
            Waiting::Words(word, text) => match said(self.dialect(), word, text) {
                Said::Nothing => Ok(()),
                Said::Comment(text) => self.between(Event::Comment(text), place),
                Said::Block(text) => self.between(Event::Text(text), place),
                Said::Stop(message) => {
                    if !message.is_empty() {
                        self.between(Event::Comment(message), place)?;
                    }
                    self.between(Event::Stop(StopKind::Program), place)
                }
            },
        }
    }

    /// An event that is no hole: the sink leaves its cycle for it.
    fn between(&mut self, event: Event<'_>, place: Place) -> Done {
        self.close_holes()?;
        self.hold.event(event, place)
    }

    /// An event; what waits for it goes first.
    #[inline]
    pub(super) fn push(&mut self, event: Event<'_>) -> Done {
        if self.change.is_some() || !self.started || self.operations == 0 {
            self.release()?;
        }
        self.hold.event(event, self.place)
    }

    /// Begins the job and the operation: nothing more is to come that belongs before.
    #[cold]
    fn release(&mut self) -> Done {
        if !self.started {
            let Some(units) = self.units.or(self.options.units) else {
                let help = "put UNITS/MM or UNITS/INCHES into the file, or say it with `--assume-units`";
                return fault(Code::PL005, "the file does not say its units", help);
            };
            self.units = Some(units);
            let start = Start {
                program: None,
                name: self.name.clone(),
                units,
                machine: crate::lang::Machine::Mill,
                set: Vec::new(),
                tool_order: None,
            };
            self.hold.event(Event::Start(&start), self.place)?;
            self.started = true;
        }
        if self.change.is_none() && self.operations == 0 {
            self.change = Some((ToolChange { coolant: self.coolant, ..no_change(None) }, self.place));
        }
        if let Some((mut change, place)) = self.change.take() {
            if change.tool.is_none() {
                let number = self.assumed_tool(self.operations == 0)?;
                change.tool = number.map(|number| Tool { number, ..Tool::default() });
            }
            change.spindle = Some(self.spindle).filter(|spindle| *spindle != Spindle::default());
            if let Some(tool) = &mut change.tool {
                tool.diameter = self.diameter;
            }
            self.operations += 1;
            self.feed_known = None;
            self.hold.tool_change(change, place)?;
        }
        for (waiting, place) in std::mem::take(&mut self.waiting) {
            self.push_waiting(&waiting, place)?;
        }
        Ok(())
    }

    /// Has a tool been loaded, or anything moved?
    pub(super) fn has_operation(&self) -> bool {
        self.operations > 0 || self.change.is_some()
    }

    /// Another tool comes: the one before is complete, whatever it did. One that is only named gives way.
    pub(super) fn complete_change(&mut self) -> Done {
        if self.change.as_ref().is_some_and(|(change, _)| change.tool.is_some()) { self.release() } else { Ok(()) }
    }

    pub(super) fn end(&mut self) -> Done {
        self.lone_insert();
        self.end_cycle()?;
        self.ended = true;
        Ok(())
    }

    fn cut_short(&self) -> Done {
        fault(Code::PL007, "the file ends inside a statement", "get the whole file")
    }

    /// The file is read.
    fn finish(&mut self) -> Done {
        if self.arc.is_some() {
            return self.cut_short();
        }
        let dialect = self.dialect();
        let ends = self.ended || self.major == Major::EndOfPath || dialect.last_statement().is_none();
        if !ends {
            let last = dialect.last_statement().unwrap_or("FINI");
            let message = format!("the file ends without {last}: it may be cut short");
            return fault(Code::PL007, message, format!("get the whole file, or put {last} at its end"));
        }
        self.end_cycle()?;
        if self.operations == 0 && self.change.is_none() {
            return fault(Code::PJ009, "the file has no motion", "look whether this is a CL file");
        }
        self.push(Event::Finish)
    }

    fn placed(&self, mut diag: Box<Diag>) -> ReadError {
        diag.place.get_or_insert_with(|| self.place.to_string());
        ReadError::Job(diag)
    }
}

/// A major word without the number of its record: `N29 GOTO`, `100 GOTO`.
fn unnumbered(name: &str) -> &str {
    let rest =
        name.strip_prefix('N').unwrap_or(name).trim_start_matches(|c: char| c.is_ascii_digit()).trim_start_matches(')');
    if major(name) == Major::Unknown && major(rest) != Major::Unknown { rest } else { name }
}

/// An operation that says nothing yet.
pub(super) fn no_change(tool: Option<Tool>) -> ToolChange {
    ToolChange {
        name: None,
        tool,
        spindle: None,
        coolant: None,
        work: None,
        feed: None,
        plunge: None,
        feed_mode: None,
        comment: None,
        set: Vec::new(),
        first: First::Nothing,
    }
}

/// A fault; the place is added by the reader.
pub(super) fn fault<T>(code: Code, message: impl Into<String>, help: impl Into<String>) -> Done<T> {
    Err(Box::new(Diag::new(code, message).help(help)))
}
