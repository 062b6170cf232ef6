//! The tree: every name, letter, variable, number, comment and lost tail with its span.

use super::expression::{Expr, Unread};
use crate::span::Span;

/// Text of the form with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spanned {
    /// As written.
    pub text: String,
    /// Where.
    pub span: Span,
}

/// One file.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Form {
    /// Lines outside sequences and whole sequences, in the order of the file.
    pub items: Vec<Head>,
}

impl Form {
    /// Commands and what looks like one.
    pub fn statements(&self) -> impl Iterator<Item = &Statement> {
        self.items.iter().filter_map(|item| if let Head::Statement(statement) = item { Some(statement) } else { None })
    }

    /// Sequences.
    pub fn sequences(&self) -> impl Iterator<Item = &SequenceNode> {
        self.items.iter().filter_map(|item| if let Head::Sequence(node) = item { Some(node.as_ref()) } else { None })
    }

    /// The words of all sequences.
    pub fn words(&self) -> impl Iterator<Item = &Word> {
        self.sequences().flat_map(|node| &node.body).flat_map(|body| &body.words)
    }

    /// All lines, in the order of the file.
    pub fn lines(&self) -> Vec<&Line> {
        let mut lines = Vec::new();
        for item in &self.items {
            match item {
                Head::Blank(line) | Head::Format { line, .. } | Head::StrayEnd(line) => lines.push(line),
                Head::Statement(statement) => lines.push(&statement.line),
                Head::Sequence(node) => {
                    lines.push(&node.name.line);
                    lines.extend(node.body.iter().map(|body| &body.line));
                    lines.extend(node.end.iter().map(|end| &end.line));
                }
            }
        }
        lines
    }
}

/// An item of the form's outermost level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Head {
    /// An empty line or a line that is a comment as a whole.
    Blank(Line),
    /// A letter format.
    Format {
        /// The line it is on.
        line: Line,
        /// The letter.
        letter: Spanned,
        /// What follows it, `->3.>4`.
        spec: Spanned,
    },
    /// A command or something that looks like one.
    Statement(Statement),
    /// `End` where no sequence is open.
    StrayEnd(Line),
    /// A sequence.
    Sequence(Box<SequenceNode>),
}

/// A line's span and what follows its words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The whole line without its end.
    pub span: Span,
    /// What stands after the words.
    pub tail: Tail,
}

/// What stands after the words of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Tail {
    /// Nothing.
    None,
    /// A comment that begins with `#`.
    Comment(Span),
    /// Text after two blanks or a tab: not output.
    Lost(Spanned),
}

/// `Rapid G0`, `Custom1   Face`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// The line.
    pub line: Line,
    /// First word.
    pub name: Spanned,
    /// The words after it; quotes are taken off.
    pub args: Vec<Spanned>,
}

/// From a name line to `End`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SequenceNode {
    /// The name line.
    pub name: Statement,
    /// The lines between.
    pub body: Vec<Body>,
    /// The end; `None` when the file or the next sequence came first.
    pub end: Option<End>,
}

impl SequenceNode {
    /// From the name line to the end, or to the last line where the end is missing.
    pub fn span(&self) -> Span {
        let end = self.end.as_ref().map(|end| end.line.span);
        let last = end.or(self.body.last().map(|body| body.line.span));
        self.name.line.span.to(last.unwrap_or(self.name.line.span))
    }
}

/// A line inside a sequence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Body {
    /// The line.
    pub line: Line,
    /// Words of the line; none on an empty line, a comment or a directive.
    pub words: Vec<Word>,
    /// What the line says of those after it, instead of words.
    pub directive: Option<Box<Directive>>,
}

/// `@if [cool] = through`: which lines print.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Directive {
    /// `@if`, as typed.
    pub name: Spanned,
    /// What stands after the name, without a comment.
    pub rest: Spanned,
    /// Which directive.
    pub kind: DirectiveKind,
}

/// The kinds of directives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DirectiveKind {
    /// `@if`: the lines after it print where the condition holds.
    If(Result<Expr, Unread>),
    /// `@elif`: else these, where that condition holds.
    Elif(Result<Expr, Unread>),
    /// `@else`: else these.
    Else,
    /// `@end` of `@if` or `@for`.
    End,
    /// `@for`: the lines after it print once for each.
    For,
    /// `@set NAME = value`.
    Set(Spanned, Result<Expr, Unread>),
    /// None of these.
    Unknown,
}

impl DirectiveKind {
    /// Does the directive begin lines that `@end` closes?
    pub fn opens(&self) -> bool {
        matches!(self, DirectiveKind::If(_) | DirectiveKind::For)
    }

    /// Do lines of a branch end before the directive?
    pub fn closes(&self) -> bool {
        matches!(self, DirectiveKind::Elif(_) | DirectiveKind::Else | DirectiveKind::End)
    }
}

/// `End`, `End Cancel`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct End {
    /// The line.
    pub line: Line,
    /// The word itself.
    pub word: Span,
    /// The words after `End`.
    pub args: Vec<Spanned>,
}

/// What stands between two blanks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Where.
    pub span: Span,
    /// More than one when a blank is missing, or in a text with variables.
    pub pieces: Vec<Piece>,
}

/// A part of a word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Where.
    pub span: Span,
    /// What.
    pub kind: PieceKind,
}

/// The kinds of parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PieceKind {
    /// `X[h]`, `<work>`.
    Variable {
        /// The letter, if any.
        letter: Option<u8>,
        /// The name between the brackets.
        name: Spanned,
    },
    /// `G0`, `P.5`, `%0`.
    Literal {
        /// The letter.
        letter: u8,
        /// The number as typed.
        number: Spanned,
    },
    /// `[h+1]`: a value that is calculated.
    Expression {
        /// The letter, if any.
        letter: Option<u8>,
        /// What stands between the brackets.
        text: Spanned,
        /// The same as a tree.
        expr: Box<Result<Expr, Unread>>,
    },
    /// `[toolname]`, `[toolname:12]`: a variable that is text.
    TextVariable {
        /// The letter, where one stands before it; none belongs there.
        letter: Option<u8>,
        /// The name between the brackets, with its width.
        name: Spanned,
    },
    /// Text in backquotes, without them: it prints as it stands.
    Quote(String),
    /// Any other text, as typed.
    Stray(String),
    /// A comment of the program, `(TOOL [tool])`.
    Note {
        /// Text and variables, in order; the marks are not among them.
        parts: Vec<Piece>,
        /// The closing mark is there.
        closed: bool,
    },
}

impl Body {
    /// The parts with which its words begin. Text in backquotes, and what sticks to it, is one word.
    pub fn begins(&self) -> impl Iterator<Item = &Piece> {
        self.words.iter().flat_map(|word| {
            let is_first = move |at: usize| at == 0 || word.pieces[at].lacks_blank_after(&word.pieces[at - 1]);
            (0..word.pieces.len()).filter(move |&at| is_first(at)).map(move |at| &word.pieces[at])
        })
    }
}

impl Piece {
    /// Is it a word of its own, with a letter and a value?
    pub fn is_word(&self) -> bool {
        matches!(self.kind, PieceKind::Variable { .. } | PieceKind::Expression { .. } | PieceKind::Literal { .. })
    }

    /// Is a blank missing between the piece before and this one? Both are printed as words all the same. A value without
    /// a letter could belong to either, which nobody guesses.
    pub fn lacks_blank_after(&self, before: &Piece) -> bool {
        let begins = match self.kind {
            PieceKind::Variable { letter, .. } | PieceKind::Expression { letter, .. } => letter.is_some(),
            PieceKind::Literal { .. } | PieceKind::Note { .. } => true,
            PieceKind::TextVariable { .. } | PieceKind::Quote(_) | PieceKind::Stray(_) => false,
        };
        before.is_word() && begins
    }
}
