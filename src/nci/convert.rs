//! Converts records to events.

use super::drilling::{Drilling, Open};
use super::records::Record;
use super::tool::{Ahead, change};
use super::{Options, wrong};
use crate::diag::{Code, Diag};
use crate::lang::Coolant;
use crate::remarks::Remarks;
use crate::toolpath::{Event, Hold, Place, ReadError, Side, Sink, Start, Stop, Units};

pub(super) type Done<T = ()> = Result<T, ReadError>;

/// How far the elements of a matrix may differ from the identity.
const STRAIGHT: f64 = 1e-6;
/// Maximum number of facts in the report.
const MOST_FACTS: usize = 20;

/// Converts the records to events, one after the other.
pub struct Convert<'r, 's> {
    hold: Hold<'s>,
    report: &'r mut Remarks,
    units: Option<Units>,
    place: Place,
    started: bool,
    over: bool,
    /// The values for the next tool change.
    ahead: Ahead,
    /// The values of the current tool.
    tool: Ahead,
    pub(super) position: Option<[f64; 3]>,
    pub(super) feed: Option<f64>,
    pub(super) side: Option<Side>,
    pub(super) coolant: Option<Coolant>,
    cycle: Option<Open>,
}

impl<'r, 's> Convert<'r, 's> {
    pub fn new(options: &Options, report: &'r mut Remarks, sink: &'s mut dyn Sink) -> Self {
        Convert {
            hold: Hold::new(sink),
            report,
            units: options.units,
            place: Place::default(),
            started: false,
            over: false,
            ahead: Ahead::default(),
            tool: Ahead::default(),
            position: None,
            feed: None,
            side: None,
            coolant: None,
            cycle: None,
        }
    }

    /// Whether the last record of the file was read.
    pub fn is_over(&self) -> bool {
        self.over
    }

    /// Handles the end of the file. `line`: the last line of the file.
    pub fn end(&self, line: u64) -> Done {
        match (line, self.over) {
            (0, _) => Err(wrong(Code::PI001, "the file is empty", "let Mastercam write the file again", 1)),
            (_, true) => Ok(()),
            (line, false) => Err(wrong(
                Code::PI004,
                "the file ends without its last record, 1003",
                "let Mastercam write the file again",
                line,
            )),
        }
    }

    /// Handles one record.
    pub fn take(&mut self, record: &Record) -> Done {
        self.place.line = record.line;
        self.place.column = 1;
        if self.place.operation > 0 {
            self.place.item += 1;
        }
        match record.code {
            0 | 1 => self.line(record),
            2 | 3 => self.arc(record),
            4 => self.dwell(record),
            11 => self.with_axis(record),
            80 => self.end_cycle(),
            81 => {
                self.end_cycle()?;
                self.hole(record)
            }
            100 => self.hole(record),
            1000..=1002 => self.change(record),
            1003 => self.finish(),
            1004 => {
                let help = "end compensation with a straight move";
                match self.side {
                    Some(_) => {
                        Err(wrong(Code::PI003, "compensation is switched off without a move (1004)", help, record.line))
                    }
                    None => Ok(()),
                }
            }
            1005 | 1007 => self.comment(record.text.trim()),
            1006 => self.text(record),
            1008 => {
                let comment = record.text.trim();
                self.ahead.comment = (!comment.is_empty()).then(|| comment.to_owned());
                Ok(())
            }
            1011 | 1012 => {
                let what = if record.code == 1011 { "reals" } else { "integers" };
                self.fact(format!("values for Mastercam's post are ignored: {what} {}", record.text.trim()));
                Ok(())
            }
            1013 => {
                let values = record.first_values(3)?;
                self.ahead.diameter = Some(values[1]);
                self.ahead.corner = Some(values[2]);
                Ok(())
            }
            1014 | 1027 => self.plane(record),
            1050 => {
                if let Some(path) = record.text.split_whitespace().nth(8) {
                    let at = record.text.find(path).unwrap_or_default();
                    self.fact(format!("Mastercam's file is {}", record.text[at..].trim()));
                }
                Ok(())
            }
            20001 => {
                self.ahead.name = Some(record.text.trim().to_owned());
                Ok(())
            }
            1025 if record.text.split_whitespace().any(|word| word.parse() != Ok(0.0)) => {
                let help = "remove the canned text from the operation: its output depends on Mastercam's post";
                Err(wrong(Code::PI003, "canned text (1025)", help, record.line))
            }
            // ignored: the construction plane, the stock, empty canned text, and data of tools and operations
            1016 | 1017 | 1020 | 1025 | 10_000.. => Ok(()),
            other => {
                let what = match other {
                    1018 | 1019 => ": a subprogram",
                    200 | 201 => ": a thread of a lathe",
                    _ => "",
                };
                let help = "post the operation from Mastercam in another form, or send us the file";
                Err(wrong(Code::PI003, format!("record {other}{what} is not supported"), help, record.line))
            }
        }
    }

    pub(super) fn push(&mut self, event: Event<'_>) -> Done {
        let place = self.place;
        self.hold.push(event, place).map_err(|stop: Stop| stop.placed(|| place.into()).into())
    }

    fn fact(&mut self, fact: String) {
        if self.report.facts.len() < MOST_FACTS && !self.report.facts.contains(&fact) {
            self.report.facts.push(fact);
        }
    }

    /// Checks that a tool change came before this record.
    pub(super) fn begun(&self, record: &Record) -> Done {
        match self.started {
            true => Ok(()),
            false => Err(wrong(
                Code::PI001,
                "a motion before the first tool change (1001)",
                "let Mastercam write the file again",
                record.line,
            )),
        }
    }

    fn change(&mut self, record: &Record) -> Done {
        self.end_cycle()?;
        if self.side.is_some() {
            return Err(wrong(
                Code::PI003,
                "the previous operation ends with compensation on",
                "end compensation with a move off the contour",
                record.line,
            ));
        }
        let values = record.values(13)?;
        self.tool = std::mem::take(&mut self.ahead).completed(values[3], std::mem::take(&mut self.tool));
        let change = change(record, &values, &self.tool)?;
        if !self.started {
            let Some(units) = self.units else {
                let help = "give --assume-units mm or inch: NCI files do not contain their units";
                return Err(wrong(Code::PI002, "the units of the file are unknown", help, record.line));
            };
            let number = values[0];
            let program = (number >= 1.0 && number.fract() == 0.0).then_some(number);
            self.push(Event::Start(&Start { program, ..Start::new(units) }))?;
            self.started = true;
        }
        self.place.operation += 1;
        self.place.item = 0;
        self.coolant = change.coolant;
        // after a tool change the position is unknown; record 1000 does not change it
        if record.code != 1000 {
            self.position = None;
        }
        self.feed = Some(values[8]).filter(|feed| *feed > 0.0).or(self.feed);
        let place = self.place;
        self.hold.tool_change(change, place).map_err(|stop| stop.placed(|| place.into()).into())
    }

    fn finish(&mut self) -> Done {
        self.end_cycle()?;
        self.over = true;
        if self.side.is_some() {
            let line = self.place.line;
            return Err(wrong(
                Code::PI003,
                "the file ends under compensation",
                "end compensation with a move off the contour",
                line,
            ));
        }
        if !self.started {
            return Err(wrong(
                Code::PI001,
                "the file has no tool change (1001)",
                "let Mastercam write the file again",
                self.place.line,
            ));
        }
        self.place = Place { line: self.place.line, column: 1, ..Place::default() };
        self.push(Event::Finish)
    }

    fn comment(&mut self, text: &str) -> Done {
        if text.is_empty() {
            return Ok(());
        }
        if self.started {
            self.end_cycle()?;
            return self.push(Event::Comment(text));
        }
        self.fact(format!("comment: {text}"));
        Ok(())
    }

    fn text(&mut self, record: &Record) -> Done {
        self.begun(record)?;
        self.end_cycle()?;
        let text = record.text.trim();
        let message = format!("`{text}` is printed unchanged, as typed in Mastercam");
        self.warn(Code::PI005, message, "check the meaning of this text on your control");
        self.push(Event::Text(text))
    }

    /// Adds a warning about the current record.
    fn warn(&mut self, code: Code, message: String, help: &str) {
        self.report.warnings.push(Diag::new(code, message).help(help).place(self.place));
    }

    /// Handles the plane of the tool or of the work. A plane that is turned or moved is refused.
    fn plane(&self, record: &Record) -> Done {
        let values = record.values(9)?;
        let straight = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let is_straight = values.iter().zip(straight).all(|(value, one)| (value - one).abs() <= STRAIGHT);
        let is_at_origin = values[9..].iter().all(|value| *value == 0.0);
        if is_straight && is_at_origin {
            return Ok(());
        }
        let which = if record.code == 1014 { "tool plane" } else { "work coordinate system" };
        let help = "use the Top plane and the world's work coordinate system: for others the frame of the points is \
            unknown";
        Err(wrong(Code::PI003, format!("a {which} that is turned or moved"), help, record.line))
    }

    fn dwell(&mut self, record: &Record) -> Done {
        self.begun(record)?;
        self.end_cycle()?;
        let values = record.values(1)?;
        if values[0] < 0.0 || values.get(1).is_some_and(|speed| *speed != 0.0) {
            let help = "a dwell has only seconds; write the speed into a separate operation";
            return Err(wrong(Code::PI003, "a dwell that changes the spindle", help, record.line));
        }
        self.push(Event::Dwell(values[0]))
    }

    fn hole(&mut self, record: &Record) -> Done {
        self.begun(record)?;
        if self.side.is_some() {
            return Err(wrong(
                Code::PI003,
                "a hole under compensation",
                "end compensation before the hole",
                record.line,
            ));
        }
        let hole = match &self.cycle {
            None if record.code == 100 => {
                return Err(wrong(
                    Code::PI001,
                    "a point of a cycle (100) without its cycle (81)",
                    "let Mastercam write the file again",
                    record.line,
                ));
            }
            Some(open) if record.code == 100 => open.next(record)?,
            _ => Drilling::read(record)?,
        };
        if let Some(message) = hole.unread().filter(|_| record.code == 81) {
            self.warn(Code::PI006, message, "compare it with the setting of the control");
        }
        if let Some(flag) = hole.flag {
            self.flag(Some(&flag), record)?;
        }
        let goes_on = self.cycle.as_ref().is_some_and(|open| open.takes(&hole));
        if !goes_on {
            self.end_cycle()?;
            let spec = hole.spec(self.feed, record)?;
            self.push(Event::CycleBegin(&spec))?;
        }
        if hole.feed > 0.0 {
            self.feed = Some(hole.feed);
        }
        self.push(Event::Hole(hole.hole()))?;
        self.position = Some([hole.at[0], hole.at[1], hole.initial]);
        self.cycle = Some(Open(hole));
        Ok(())
    }

    pub(super) fn end_cycle(&mut self) -> Done {
        match self.cycle.take() {
            Some(_) => self.push(Event::CycleEnd),
            None => Ok(()),
        }
    }
}
