//! A form with its names resolved.

use indexmap::IndexMap;

use super::formula::Formula;
use super::settings::Settings;
use super::step::Step;
use crate::control::Code;
use crate::lang::{SequenceId, TextVar, VarId, VarSet};
use crate::number::LetterFormat;
use crate::span::Span;

/// An analysed form. It can be rendered if the analysis found no error.
#[derive(Clone, Debug, Default)]
pub struct Form {
    /// Settings from the commands.
    pub settings: Settings,
    /// Letter formats by letter, with the location of each.
    pub formats: IndexMap<u8, (LetterFormat, Span)>,
    /// Packed words, as `A010360`: the letter and its digits as typed.
    pub packed: IndexMap<u8, String>,
    /// The sequences in file order.
    pub sequences: IndexMap<SequenceId, Sequence>,
    /// `Upon [var]` and `Upon Every [var]`.
    pub upons: Vec<Upon>,
}

/// A sequence.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// Its name.
    pub id: SequenceId,
    /// The name line.
    pub span: Span,
    /// The line count of an advanced cycle.
    pub count: Option<usize>,
    /// The comment on the name line. For a Custom cycle it names the kind of cycle.
    pub remark: Option<String>,
    /// The body consists of the word `None`.
    pub is_none: bool,
    /// `End Cancel`.
    pub cancel: Option<Span>,
    /// The lines that print.
    pub lines: Vec<Line>,
    /// Selection of the lines by directives, if there are any.
    pub steps: Option<Vec<Step>>,
}

impl Sequence {
    /// The kind of cycle that a Custom sequence prints: the first word of its comment.
    pub fn custom_kind(&self) -> Option<&str> {
        let is_custom = matches!(self.id, SequenceId::Custom1 | SequenceId::Custom2 | SequenceId::Custom3);
        self.remark.as_deref().filter(|_| is_custom).and_then(kind_of_remark)
    }
}

/// The first word of a Custom cycle's comment: the kind of cycle that it prints.
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
    /// Selection of the lines by directives, if there are any.
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
    /// Location of the word.
    pub span: Span,
    /// No space precedes it in the output.
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
    /// A variable inside a comment of the program; the control does not read its value.
    Remark(VarId),
    /// A letter with a number, printed as typed.
    Literal(u8, String, f64),
    /// Text as typed.
    Text(String),
    /// Text of a comment of the program.
    Note(String),
    /// Text in backquotes: neither checked nor changed.
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
    /// A text property inside a comment of the program.
    RemarkProperty(u16),
    /// A comment with texts of the job, made of this many following words. It is left out if all of its texts are empty.
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

    /// Variable of the word, unless the word is in a comment.
    pub fn printed_var(&self) -> Option<VarId> {
        match self.kind {
            WordKind::Var(_, var) | WordKind::Value(var) => Some(var),
            _ => None,
        }
    }

    /// Variables whose values the word prints outside comments, directly or in a calculation.
    pub fn printed_vars(&self) -> VarSet {
        match &self.kind {
            WordKind::Formula(_, formula) => formula.vars(),
            _ => self.printed_var().map_or_else(VarSet::default, |var| VarSet::of(&[var])),
        }
    }

    /// Variables whose values the word prints, in comments too.
    pub fn told_vars(&self) -> VarSet {
        match &self.kind {
            WordKind::Formula(_, formula) | WordKind::RemarkFormula(formula) => formula.vars(),
            _ => self.var().map_or_else(VarSet::default, |var| VarSet::of(&[var])),
        }
    }

    /// The typed G or M code of the word, also after the slash of block delete.
    pub fn code(&self) -> Option<Code> {
        b"GM".iter().find_map(|&letter| Code::of(letter, self.typed(letter)?))
    }

    /// Is the word one of these typed codes?
    pub fn is_code(&self, letter: u8, codes: &[f64]) -> bool {
        self.typed(letter).is_some_and(|value| codes.contains(&value))
    }

    /// The typed number of a word with this letter, also after the slash of block delete.
    pub fn typed(&self, letter: u8) -> Option<f64> {
        match &self.kind {
            WordKind::Literal(own, _, value) if *own == letter => Some(*value),
            WordKind::Text(text) => text.strip_prefix('/')?.strip_prefix(char::from(letter))?.parse().ok(),
            _ => None,
        }
    }
}
