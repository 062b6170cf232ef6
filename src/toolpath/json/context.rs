//! The current location of a reader in the document, and the failure that stopped the reader.

use std::cell::{Cell, RefCell};
use std::fmt::Write;

use serde::de;

use crate::diag::{Code, Diag, Location};
use crate::suggest::did_you_mean;
use crate::toolpath::{ReadError, Stop};

/// A step of the path inside the document: a key or an index.
#[derive(Clone, Copy, Debug)]
pub enum Step {
    /// A key.
    Key(&'static str),
    /// An index in a list, from 0.
    Index(u64),
}

/// Data that the readers of one job share: the path to the current value, and the failure that stopped reading.
#[derive(Default)]
pub struct Context {
    /// Line and column of the last byte read. Only the reader of documents counts lines and columns.
    pub at: Cell<(u64, u32)>,
    /// Line and column where the last point of a cycle began.
    pub point_at: Cell<(u64, u32)>,
    path: RefCell<Vec<Step>>,
    failure: RefCell<Option<Stop>>,
}

impl Context {
    /// Enters one step of the path.
    pub fn enter(&self, step: Step) {
        self.path.borrow_mut().push(step);
    }

    /// Leaves one step of the path. Readers don't call this function after an error, so the path still shows the
    /// location of the error.
    pub fn leave(&self) {
        self.path.borrow_mut().pop();
    }

    /// Adds the lines and columns of bytes that were read.
    pub fn pass(&self, bytes: &[u8]) {
        let (line, column) = self.at.get();
        let lines = memchr::memchr_iter(b'\n', bytes);
        self.at.set(match lines.clone().next_back() {
            Some(last) => (line + lines.count() as u64, (bytes.len() - last - 1) as u32),
            None => (line, column + bytes.len() as u32),
        });
    }

    /// Keeps a finding and returns an error for serde. `Context::explain` replaces the serde error by the finding.
    pub fn fail<E: de::Error>(&self, diag: Diag) -> E {
        self.fail_with(diag.into())
    }

    /// Keeps the reason why a sink stopped and returns an error for serde.
    pub fn fail_with<E: de::Error>(&self, stop: Stop) -> E {
        *self.failure.borrow_mut() = Some(stop);
        E::custom("stopped")
    }

    /// Keeps a finding that stops reading, and returns an error for the reader of bytes.
    pub fn fail_reading(&self, diag: Diag) -> std::io::Error {
        *self.failure.borrow_mut() = Some(diag.into());
        std::io::Error::other("stopped")
    }

    /// The path to the current value, such as `operations[0].path[3].line`.
    pub fn path(&self) -> String {
        let mut text = String::new();
        for step in self.path.borrow().iter() {
            match step {
                Step::Key(key) if text.is_empty() => text.push_str(key),
                Step::Key(key) => _ = write!(text, ".{key}"),
                Step::Index(index) => _ = write!(text, "[{index}]"),
            }
        }
        text
    }

    /// The failure that caused an error of serde. `line` and `column` are the location of the serde error.
    pub fn explain(&self, error: serde_json::Error, line: u64, column: u32) -> ReadError {
        let failure = self.failure.borrow_mut().take();
        if failure.is_none() && error.is_io() {
            return ReadError::Io(error.into());
        }
        let stop = failure.unwrap_or_else(|| of_serde(&error).into());
        stop.placed(|| Location::at(line, column).step(self.path())).into()
    }
}

/// The finding if the first bytes of a text show that the text is not UTF-8.
pub fn not_utf_8(start: &[u8]) -> Option<Diag> {
    let marked = start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff");
    // UTF-16 without a byte order mark: every second byte is zero
    let bare = matches!(start, [0, b'{', ..] | [b'{', 0, ..]);
    (marked || bare).then(|| {
        Diag::new(Code::PJ001, "the job is UTF-16")
            .help("save the job as UTF-8; in PowerShell with `| Out-File -Encoding utf8 job.json` instead of `>`")
    })
}

/// Converts an error of serde to a finding in postform's terms.
fn of_serde(error: &serde_json::Error) -> Diag {
    let text = error.to_string();
    let text = text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message);
    match error.classify() {
        serde_json::error::Category::Eof => Diag::new(Code::PJ007, "the job ends in the middle of a value")
            .help("write the job again: postform prints no program from an incomplete job"),
        serde_json::error::Category::Data => {
            let mut diag = Diag::new(Code::PJ003, text.to_owned());
            diag.help = meant(text);
            diag
        }
        _ if text.contains("trailing characters") => {
            Diag::new(Code::PJ008, "there is text after the end of the job").help("a job file must contain one job")
        }
        _ if text.contains("number out of range") => {
            Diag::new(Code::PJ003, "the number is too large").help("give a number that a machine can reach")
        }
        _ if text.contains("recursion limit") => Diag::new(Code::PJ001, "nested too deep"),
        _ if text.contains("invalid unicode code point") => {
            Diag::new(Code::PJ001, "the job is not UTF-8").help("save the job as UTF-8")
        }
        _ => {
            let mut diag = Diag::new(Code::PJ001, format!("this is not JSON: {text}"));
            diag.help = instead(text).map(str::to_owned);
            diag
        }
    }
}

/// A suggestion for a word that is not in the list of words, or for a text that should be a number.
fn meant(text: &str) -> Option<String> {
    /// Words that users or other formats use instead of postform's words.
    const ALSO: [(&str, &str); 15] = [
        ("metric", "mm"),
        ("millimeter", "mm"),
        ("millimeters", "mm"),
        ("imperial", "inch"),
        ("inches", "inch"),
        ("in", "inch"),
        ("clockwise", "cw"),
        ("counterclockwise", "ccw"),
        ("m3", "cw"),
        ("m4", "ccw"),
        ("peck", "deep"),
        ("pecking", "deep"),
        ("tapping", "tap"),
        ("boring", "bore"),
        ("countersink", "csink"),
    ];
    if let Some((_, example)) = OBJECTS.iter().find(|(name, _)| text.ends_with(&format!("expected {name}, an object")))
    {
        return Some(format!("write an object, such as `{example}`"));
    }
    let (given, expected) = text.split_once(": string \"")?.1.split_once("\", expected ")?;
    if expected == "a number" {
        let digits = given.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let number = digits.parse::<f64>().ok().map(|_| format!("write {digits}, without quotes"));
        return number.or_else(|| fixture(given));
    }
    let words = || expected.split(" or ").map(|word| word.trim_matches('"'));
    let lower = given.to_lowercase();
    let known = ALSO.iter().find(|(also, _)| *also == lower).map(|(_, word)| *word);
    match words().find(|&word| word == lower || known == Some(word)) {
        Some(word) => Some(format!("write \"{word}\"")),
        None => did_you_mean(given, words()),
    }
}

/// Objects of a job, each with an example.
const OBJECTS: [(&str, &str); 5] = [
    ("a tool", r#"{"number": 1, "diameter": 10}"#),
    ("a spindle", r#"{"speed": 1000, "direction": "cw"}"#),
    ("an arc", r#"{"to": [10, 0], "center": [5, 0], "direction": "cw"}"#),
    ("a cycle", r#"{"kind": "drill", "depth": 10, "clear": 2, "feed": 100, "points": [[0, 0, 0]]}"#),
    ("a call", r#"{"sub": 100, "times": 1}"#),
];

/// A suggestion for the words of an additional work offset, such as `G54.1 P1`, instead of the number of its fixture.
fn fixture(given: &str) -> Option<String> {
    const FIRST: u32 = 7;
    let (code, word) = given.split_once(' ')?;
    let letter = word.get(..1)?;
    let number = word.get(1..)?.parse::<u32>().ok().filter(|number| (1..=999).contains(number))?;
    let fixture = match FIRST - 1 + number {
        fixture @ ..50 => fixture,
        // from 50 on, numbers are codes: 54 is the code of the first fixture
        fixture => fixture + 53,
    };
    let more = format!("`MoreWork {FIRST} {code} {letter}1`");
    Some(format!("write the number of the fixture, without quotes: {fixture} in a form with {more}"))
}

/// The correction for a common mistake in JSON.
fn instead(text: &str) -> Option<&'static str> {
    const KNOWN: [(&str, &str); 5] = [
        ("expected `,`", "a comma is missing here, or at the end of the line above"),
        ("trailing comma", "take out the comma before this bracket"),
        ("key must be a string", "put keys and texts in double quotes: `\"units\": \"mm\"`"),
        ("expected `:`", "put a colon between a key and its value: `\"units\": \"mm\"`"),
        ("expected value", "write a value here: a number, a text in double quotes, [..] or {..}; JSON has no comments"),
    ];
    KNOWN.iter().find(|(begins, _)| text.starts_with(begins)).map(|(_, help)| *help)
}
