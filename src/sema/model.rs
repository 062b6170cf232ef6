//! The analysed form, with resolved names.

use indexmap::IndexMap;

use super::formula::Formula;
use super::settings::Settings;
use super::step::Step;
use crate::control::Code;
use crate::lang::{SequenceId, TextVar, VarId, VarSet};
use crate::number::LetterFormat;
use crate::span::Span;

/// An analysed form. A form can be rendered if the analysis found no error.
#[derive(Clone, Debug, Default)]
pub struct Form {
    /// Settings from the commands.
    pub settings: Settings,
    /// The formats of letters, each with its location.
    pub formats: IndexMap<u8, (LetterFormat, Span)>,
    /// Words without separators, as `A010360`: the letter and its digits as written.
    pub packed: IndexMap<u8, String>,
    /// The sequences in file order.
    pub sequences: IndexMap<SequenceId, Sequence>,
    /// The sequences `Upon [var]` and `Upon Every [var]`.
    pub upons: Vec<Upon>,
}

/// A sequence.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// Its name.
    pub id: SequenceId,
    /// The name line.
    pub span: Span,
    /// For an advanced cycle, the number of lines that print at the first hole only.
    pub count: Option<usize>,
    /// The comment after the name. For a Custom cycle the comment names the kind of cycle.
    pub remark: Option<String>,
    /// Whether the body consists of the word `None`.
    pub is_none: bool,
    /// The location of `Cancel` in `End Cancel`.
    pub cancel: Option<Span>,
    /// The lines that print.
    pub lines: Vec<Line>,
    /// The directives that select the lines, if there are any.
    pub steps: Option<Vec<Step>>,
}

impl Sequence {
    /// The kind of cycle that a Custom sequence prints: the first word of the sequence's comment.
    pub fn custom_kind(&self) -> Option<&str> {
        let is_custom = matches!(self.id, SequenceId::Custom1 | SequenceId::Custom2 | SequenceId::Custom3);
        self.remark.as_deref().filter(|_| is_custom).and_then(kind_of_remark)
    }
}

/// The first word of a comment. In a Custom cycle this word names the kind of cycle.
pub fn kind_of_remark(remark: &str) -> Option<&str> {
    remark.split([' ', '\t', ',', '(']).next().filter(|word| !word.is_empty())
}

/// An Upon: a sequence that prints when a variable changes, or at each use of the variable.
#[derive(Clone, Debug)]
pub struct Upon {
    /// The variable that triggers the sequence.
    pub var: VarId,
    /// Whether the sequence prints at each use of the variable (`Every`).
    pub every: bool,
    /// The name line.
    pub span: Span,
    /// The lines that print.
    pub lines: Vec<Line>,
    /// The directives that select the lines, if there are any.
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
    /// Whether the word follows the previous word without a space.
    pub glued: bool,
    /// What the word prints.
    pub kind: WordKind,
}

/// The output of a word.
#[derive(Clone, Debug, PartialEq)]
pub enum WordKind {
    /// A letter and the value of a variable.
    Var(u8, VarId),
    /// The value of a variable without a letter.
    Value(VarId),
    /// A variable inside a comment of the program. The control does not read the value in the comment.
    Remark(VarId),
    /// A letter and a number, printed as written in the form.
    Literal(u8, String, f64),
    /// Text, printed as written in the form.
    Text(String),
    /// Text of a comment of the program.
    Note(String),
    /// Text in backquotes, which is neither checked nor changed.
    Quote(String),
    /// A calculated value, with or without a letter.
    Formula(Option<u8>, Box<Formula>),
    /// A calculated value inside a comment of the program.
    RemarkFormula(Box<Formula>),
    /// A text of the job.
    TextVar(TextVar),
    /// A text of the job inside a comment of the program.
    RemarkText(TextVar),
    /// A property with a text value, by its row.
    PropertyText(u16),
    /// A property with a text value inside a comment of the program.
    RemarkProperty(u16),
    /// A comment with texts of the job. The number counts the following words that belong to the comment. The comment
    /// is not printed if all its texts are empty.
    Comment(usize),
}

impl Word {
    /// The letter of the word; `None` if the word is text.
    pub fn letter(&self) -> Option<u8> {
        match self.kind {
            WordKind::Var(letter, _) | WordKind::Literal(letter, ..) => Some(letter),
            WordKind::Formula(letter, _) => letter,
            _ => None,
        }
    }

    /// The variable of the word, if it has one.
    pub fn var(&self) -> Option<VarId> {
        match self.kind {
            WordKind::Var(_, var) | WordKind::Value(var) | WordKind::Remark(var) => Some(var),
            _ => None,
        }
    }

    /// The variable of the word; `None` if the word is in a comment.
    pub fn printed_var(&self) -> Option<VarId> {
        match self.kind {
            WordKind::Var(_, var) | WordKind::Value(var) => Some(var),
            _ => None,
        }
    }

    /// The variables whose values the word prints outside comments, directly or in a calculation.
    pub fn printed_vars(&self) -> VarSet {
        match &self.kind {
            WordKind::Formula(_, formula) => formula.vars(),
            _ => self.printed_var().map_or_else(VarSet::default, |var| VarSet::of(&[var])),
        }
    }

    /// The variables whose values the word prints, in comments too.
    pub fn told_vars(&self) -> VarSet {
        match &self.kind {
            WordKind::Formula(_, formula) | WordKind::RemarkFormula(formula) => formula.vars(),
            _ => self.var().map_or_else(VarSet::default, |var| VarSet::of(&[var])),
        }
    }

    /// The G or M code of the word if the code is a number in the form. A slash for block delete may precede the code.
    pub fn code(&self) -> Option<Code> {
        b"GM".iter().find_map(|&letter| Code::of(letter, self.typed(letter)?))
    }

    /// Whether the word is one of these codes.
    pub fn is_code(&self, letter: u8, codes: &[f64]) -> bool {
        self.typed(letter).is_some_and(|value| codes.contains(&value))
    }

    /// The number of a word with this letter if the number is written in the form. A slash for block delete may precede
    /// the word.
    pub fn typed(&self, letter: u8) -> Option<f64> {
        match &self.kind {
            WordKind::Literal(own, _, value) if *own == letter => Some(*value),
            WordKind::Text(text) => text.strip_prefix('/')?.strip_prefix(char::from(letter))?.parse().ok(),
            _ => None,
        }
    }
}
