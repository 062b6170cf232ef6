//! Findings as data: raised anywhere, shown by the command line.

mod codes;
mod findings;
mod location;

pub use codes::{CODES, Code, CodeRow};
pub use findings::Findings;
pub use location::Location;

use crate::span::Span;
use crate::terminal::{escaped, steers};

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; does not change the exit status.
    Note,
    /// The program is printed, but look at it.
    Warning,
    /// An error: nothing is printed.
    Error,
}

impl Severity {
    /// The word used in messages and in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// A place in form text and what is to be said of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place in the form's text.
    pub span: Span,
    /// A few words under the place.
    pub text: String,
}

/// A change of form text that would fix a finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What the change does, in the imperative.
    pub title: String,
    /// Safe: the NC output of every job stays the same, byte for byte.
    pub safe: bool,
    /// Pieces of text and what replaces each; they do not overlap.
    pub edits: Vec<(Span, String)>,
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diag {
    /// Row in the table of codes.
    pub code: Code,
    /// As the table says, unless limits were relaxed or a shop's levels say otherwise.
    pub severity: Severity,
    /// What is wrong, one sentence.
    pub message: String,
    /// The places in the form, the main one first.
    pub labels: Vec<Label>,
    /// The place in the job or in the program.
    pub place: Option<Location>,
    /// What to type instead.
    pub help: Option<String>,
    /// What to type instead, as an edit of the form.
    pub fix: Option<Fix>,
}

impl Diag {
    /// A finding with the severity of its code and no place yet.
    ///
    /// Messages hold text from files: what would steer a terminal is escaped, what is too long is cut in the middle.
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        Diag {
            code,
            severity: code.row().severity,
            message: shown(message.into()),
            labels: Vec::new(),
            place: None,
            help: None,
            fix: None,
        }
    }

    /// Adds a place in the form; the first one added is the main one.
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: shown(text.into()) });
        self
    }

    /// Adds the place in the job or in the program.
    pub fn place(mut self, place: impl Into<Location>) -> Self {
        self.place = Some(place.into());
        self
    }

    /// Adds what to type instead.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(shown(help.into()));
        self
    }

    /// Adds an edit that fixes it.
    pub fn fix(mut self, title: impl Into<String>, safe: bool, edits: Vec<(Span, String)>) -> Self {
        self.fix = Some(Fix { title: shown(title.into()), safe, edits });
        self
    }

    /// Is the finding an error?
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

/// Longest message or help, in characters.
const LONGEST: usize = 400;
/// How many characters of a word messages show; a number of 309 digits is longer.
const LONGEST_WORD: usize = 100;

fn shown(text: String) -> String {
    let text = if text.chars().any(steers) { escaped(&text) } else { text };
    if text.len() <= LONGEST_WORD {
        return text;
    }
    let words: Vec<String> = text.split(' ').map(|word| cut(word, LONGEST_WORD, "…")).collect();
    cut(&words.join(" "), LONGEST, " … ")
}

/// A text without its middle where it is longer than `most` characters.
fn cut(text: &str, most: usize, mark: &str) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.to_owned();
    }
    let head: String = text.chars().take(most / 2).collect();
    let tail: String = text.chars().skip(count - most / 2).collect();
    format!("{head}{mark}{tail}")
}
