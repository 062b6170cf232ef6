//! Findings as data. Any part of postform may create findings; the command line displays them.

mod codes;
mod findings;
mod location;
mod suggestion;

pub use codes::{CODES, Code, CodeRow};
pub use findings::Findings;
pub use location::Location;
pub(crate) use suggestion::suggestion;

use crate::span::Span;
use crate::terminal::{is_invisible, visible};

/// The severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Useful information. A note does not change the exit status.
    Note,
    /// The program is printed, but must be checked.
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

/// A location in the form's text, and a text about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The location in the form's text.
    pub span: Span,
    /// A few words that are printed under the location.
    pub text: String,
}

/// A change of the form text that fixes a finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What the change does, in the imperative.
    pub title: String,
    /// Whether the change is safe: the NC output of every job stays the same, byte for byte.
    pub safe: bool,
    /// Pieces of the form's text, with their replacements. The pieces do not overlap.
    pub edits: Vec<(Span, String)>,
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diag {
    /// The code of the finding: a row in the table of codes.
    pub code: Code,
    /// The severity from the table of codes, or another severity set by relaxed limits or by a shop's levels.
    pub severity: Severity,
    /// The problem in one sentence.
    pub message: String,
    /// The locations in the form, the main one first.
    pub labels: Vec<Label>,
    /// The location in the job or in the program.
    pub place: Option<Box<Location>>,
    /// A proposed correction.
    pub help: Option<String>,
    /// The correction as an edit of the form.
    pub fix: Option<Box<Fix>>,
}

impl Diag {
    /// A finding with the severity from the table, and no location yet.
    ///
    /// Messages may contain text from files: control characters are escaped, and long text is cut in the middle.
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

    /// Adds a location in the form; the first one added is the main one.
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.reserve_exact(1); // most findings have one location, and a form may have 100,000 findings
        self.labels.push(Label { span, text: shown(text.into()) });
        self
    }

    /// Adds the location in the job or in the program.
    pub fn place(mut self, place: impl Into<Location>) -> Self {
        self.place = Some(Box::new(place.into()));
        self
    }

    /// Adds a proposed correction.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(shown(help.into()));
        self
    }

    /// Adds an edit that fixes the finding.
    pub fn fix(mut self, title: impl Into<String>, safe: bool, edits: Vec<(Span, String)>) -> Self {
        self.fix = Some(Box::new(Fix { title: shown(title.into()), safe, edits }));
        self
    }

    /// Whether the finding is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

/// Maximum number of characters of a message or a help text.
const LONGEST: usize = 400;
/// Maximum number of characters of a word in a message. A word that is a number, for example, may have 309 digits.
const LONGEST_WORD: usize = 100;

fn shown(text: String) -> String {
    let mut text = if text.chars().any(is_invisible) { visible(&text) } else { text };
    if text.len() <= LONGEST_WORD {
        text.shrink_to_fit(); // `format!` reserves twice the length, and a form may have 100,000 findings
        return text;
    }
    let words: Vec<String> = text.split(' ').map(|word| cut(word, LONGEST_WORD, "…")).collect();
    cut(&words.join(" "), LONGEST, " … ")
}

/// If the text is longer than `most` characters, replaces its middle by `mark`.
fn cut(text: &str, most: usize, mark: &str) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.to_owned();
    }
    let head: String = text.chars().take(most / 2).collect();
    let tail: String = text.chars().skip(count - most / 2).collect();
    format!("{head}{mark}{tail}")
}
