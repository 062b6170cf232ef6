//! A form with its names resolved.

use indexmap::IndexMap;

use super::formula::Formula;
use super::settings::Settings;
use super::step::Step;
use crate::control::Code;
use crate::lang::{SequenceId, TextVar, VarId, VarSet};
use crate::number::LetterFormat;
use crate::span::Span;

/// A form that was read. It can be rendered when reading it raised no error.
#[derive(Clone, Debug, Default)]
pub struct Form {
    /// What the commands say.
    pub settings: Settings,
    /// Letter formats by letter, with the place of each.
    pub formats: IndexMap<u8, (LetterFormat, Span)>,
    /// Packed words, `A010360`: the letter and its digits as typed.
    pub packed: IndexMap<u8, String>,
    /// The sequences in the order of the file.
    pub sequences: IndexMap<SequenceId, Sequence>,
    /// `Upon [var]` and `Upon Every [var]`.
    pub upons: Vec<Upon>,
}

/// A sequence.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// Which.
    pub id: SequenceId,
    /// The name line.
    pub span: Span,
    /// The count of an advanced cycle.
    pub count: Option<usize>,
    /// The remark on the name line; names the kind of a Custom cycle.
    pub remark: Option<String>,
    /// The body is the single word `None`.
    pub is_none: bool,
    /// `End Cancel`.
    pub cancel: Option<Span>,
    /// The lines that print.
    pub lines: Vec<Line>,
    /// Which of them print when, where directives say it.
    pub steps: Option<Vec<Step>>,
}

impl Sequence {
    /// The kind of cycle that a Custom serves, by the first word of its remark.
    pub fn custom_kind(&self) -> Option<&str> {
        let is_custom = matches!(self.id, SequenceId::Custom1 | SequenceId::Custom2 | SequenceId::Custom3);
        self.remark.as_deref().filter(|_| is_custom).and_then(kind_of_remark)
    }
}

/// The first word of a Custom cycle's remark: the kind of cycle that it serves.
pub fn kind_of_remark(remark: &str) -> Option<&str> {
    remark.split([' ', '\t', ',', '(']).next().filter(|word| !word.is_empty())
}

/// A sequence printed when a variable changes, or whenever it is used.
#[derive(Clone, Debug)]
pub struct Upon {
    /// The variable it watches.
    pub var: VarId,
    /// `Every`: at every use.
    pub every: bool,
    /// The name line.
    pub span: Span,
    /// The lines that print.
    pub lines: Vec<Line>,
    /// Which of them print when, where directives say it.
    pub steps: Option<Vec<Step>>,
}

/// A line with words.
#[derive(Clone, Debug)]
pub struct Line {
    /// The whole line.
    pub span: Span,
    /// Words of the line.
    pub words: Vec<Word>,
}

/// One word of a line.
#[derive(Clone, Debug)]
pub struct Word {
    /// Where.
    pub span: Span,
    /// No blank stands before it in the output.
    pub glued: bool,
    /// What the word prints.
    pub kind: WordKind,
}

/// What a word prints.
#[derive(Clone, Debug, PartialEq)]
pub enum WordKind {
    /// A letter with a variable's value.
    Var(u8, VarId),
    /// A variable's value alone.
    Value(VarId),
    /// A variable inside a comment of the program: its value is for people.
    Remark(VarId),
    /// A letter with a number, printed as typed.
    Literal(u8, String, f64),
    /// Text as typed.
    Text(String),
    /// Text of a comment of the program.
    Note(String),
    /// Text in backquotes: nothing about it is looked at or changed.
    Quote(String),
    /// A calculated value, with its letter if it has one.
    Formula(Option<u8>, Box<Formula>),
    /// A calculated value inside a comment of the program.
    RemarkFormula(Box<Formula>),
    /// A text of the job.
    TextVar(TextVar),
    /// A text of the job inside a comment of the program.
    RemarkText(TextVar),
    /// A property that is a text, by its row.
    PropertyText(u16),
    /// The same inside a comment of the program.
    RemarkProperty(u16),
    /// So many words that follow are a comment with texts of the job: left out where the job has none of them.
    Comment(usize),
}

impl Word {
    /// Letter of the word, unless the word is text.
    pub fn letter(&self) -> Option<u8> {
        match self.kind {
            WordKind::Var(letter, _) | WordKind::Literal(letter, ..) => Some(letter),
            WordKind::Formula(letter, _) => letter,
            _ => None,
        }
    }

    /// Variable of the word, if it has one.
    pub fn var(&self) -> Option<VarId> {
        match self.kind {
            WordKind::Var(_, var) | WordKind::Value(var) | WordKind::Remark(var) => Some(var),
            _ => None,
        }
    }

    /// Variable of the word, unless that stands in a comment.
    pub fn printed_var(&self) -> Option<VarId> {
        match self.kind {
            WordKind::Var(_, var) | WordKind::Value(var) => Some(var),
            _ => None,
        }
    }

    /// The variables whose values it prints outside comments, by themselves or calculated with.
    pub fn printed_vars(&self) -> VarSet {
        match &self.kind {
            WordKind::Formula(_, formula) => formula.vars(),
            _ => self.printed_var().map_or_else(VarSet::default, |var| VarSet::of(&[var])),
        }
    }

    /// The variables whose values it prints, be it in a comment.
    pub fn told_vars(&self) -> VarSet {
        match &self.kind {
            WordKind::Formula(_, formula) | WordKind::RemarkFormula(formula) => formula.vars(),
            _ => self.var().map_or_else(VarSet::default, |var| VarSet::of(&[var])),
        }
    }

    /// The G or M code that is typed in it; after the slash of block delete, too.
    pub fn code(&self) -> Option<Code> {
        b"GM".iter().find_map(|&letter| Code::of(letter, self.typed(letter)?))
    }

    /// Is it one of these codes, as typed?
    pub fn is_code(&self, letter: u8, codes: &[f64]) -> bool {
        self.typed(letter).is_some_and(|value| codes.contains(&value))
    }

    /// Number of the word, if the word has this letter and is typed; after the slash of block delete, too.
    pub fn typed(&self, letter: u8) -> Option<f64> {
        match &self.kind {
            WordKind::Literal(own, _, value) if *own == letter => Some(*value),
            WordKind::Text(text) => text.strip_prefix('/')?.strip_prefix(char::from(letter))?.parse().ok(),
            _ => None,
        }
    }
}
