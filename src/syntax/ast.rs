//! The syntax tree: every name, letter, variable, number, comment and lost tail with its span.

use super::expression::{Expr, Unread};
use crate::span::Span;

/// Text of the form with its location.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spanned {
    /// Text as typed.
    pub text: String,
    /// Location.
    pub span: Span,
}

/// One file.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Form {
    /// Lines outside sequences, and sequences, in file order.
    pub items: Vec<Head>,
}

impl Form {
    /// Commands, and lines that look like one.
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

/// An item at the outermost level of a form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Head {
    /// An empty line or a line with only a comment.
    Blank(Line),
    /// A letter format.
    Format {
        /// The line.
        line: Line,
        /// The letter.
        letter: Spanned,
        /// The text after it, `->3.>4`.
        spec: Spanned,
    },
    /// A command, or a line that looks like one.
    Statement(Statement),
    /// `End` while no sequence is open.
    StrayEnd(Line),
    /// A sequence.
    Sequence(Box<SequenceNode>),
}

/// The span of a line, and the text after its words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The whole line without its line end.
    pub span: Span,
    /// Text after the words.
    pub tail: Tail,
}

/// Text after the words of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Tail {
    /// Nothing.
    None,
    /// A comment that begins with `#`.
    Comment(Span),
    /// Text after two spaces or a tab, which is not printed.
    Lost(Spanned),
}

/// `Rapid G0`, `Custom1   Face`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// The line.
    pub line: Line,
    /// First word.
    pub name: Spanned,
    /// The words after it, without quotes.
    pub args: Vec<Spanned>,
}

/// From a name line to `End`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SequenceNode {
    /// The name line.
    pub name: Statement,
    /// The lines between name and end.
    pub body: Vec<Body>,
    /// The end; `None` if the file ends or the next sequence begins before it.
    pub end: Option<End>,
}

impl SequenceNode {
    /// From the name line to the end, or to the last line if the end is missing.
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
    /// The directive, on a line with one instead of words.
    pub directive: Option<Box<Directive>>,
}

/// `@if [cool] = through`: selects the lines that print.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Directive {
    /// `@if`, as typed.
    pub name: Spanned,
    /// The text after the name, without a comment.
    pub rest: Spanned,
    /// Kind of the directive.
    pub kind: DirectiveKind,
}

/// The kinds of directives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DirectiveKind {
    /// `@if`: the lines after it print if the condition is true.
    If(Result<Expr, Unread>),
    /// `@elif`: otherwise these lines, if that condition is true.
    Elif(Result<Expr, Unread>),
    /// `@else`: otherwise these lines.
    Else,
    /// `@end` of `@if` or `@for`.
    End,
    /// `@for`: the lines after it print once for each item.
    For,
    /// `@set NAME = value`.
    Set(Spanned, Result<Expr, Unread>),
    /// Any other text.
    Unknown,
}

impl DirectiveKind {
    /// Does the directive begin lines that `@end` closes?
    pub fn opens(&self) -> bool {
        matches!(self, DirectiveKind::If(_) | DirectiveKind::For)
    }

    /// Does the directive end the lines of a branch?
    pub fn closes(&self) -> bool {
        matches!(self, DirectiveKind::Elif(_) | DirectiveKind::Else | DirectiveKind::End)
    }
}

/// `End`, `End Cancel`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct End {
    /// The line.
    pub line: Line,
    /// Span of the word `End`.
    pub word: Span,
    /// The words after `End`.
    pub args: Vec<Spanned>,
}

/// The text between two spaces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Location.
    pub span: Span,
    /// Its parts. There are several if a space is missing, or in a text with variables.
    pub pieces: Vec<Piece>,
}

/// A part of a word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Location.
    pub span: Span,
    /// Kind.
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
    /// `[h+1]`: a calculated value.
    Expression {
        /// The letter, if any.
        letter: Option<u8>,
        /// The text between the brackets.
        text: Spanned,
        /// The expression as a tree.
        expr: Box<Result<Expr, Unread>>,
    },
    /// `[toolname]`, `[toolname:12]`: a variable with a text value.
    TextVariable {
        /// A letter before it, which is an error.
        letter: Option<u8>,
        /// The name between the brackets, with its width.
        name: Spanned,
    },
    /// Text in backquotes, without them. It prints as typed.
    Quote(String),
    /// Any other text, as typed.
    Stray(String),
    /// A comment of the program, `(TOOL [tool])`.
    Note {
        /// Text and variables in order, without the comment marks.
        parts: Vec<Piece>,
        /// The closing mark exists.
        closed: bool,
    },
}

impl Body {
    /// The first part of each printed word. Text in backquotes and the parts joined to it are one word.
    pub fn begins(&self) -> impl Iterator<Item = &Piece> {
        self.words.iter().flat_map(|word| {
            let is_first = move |at: usize| at == 0 || word.pieces[at].lacks_blank_after(&word.pieces[at - 1]);
            (0..word.pieces.len()).filter(move |&at| is_first(at)).map(move |at| &word.pieces[at])
        })
    }
}

impl Piece {
    /// Is the part a complete word, with a letter and a value?
    pub fn is_word(&self) -> bool {
        matches!(self.kind, PieceKind::Variable { .. } | PieceKind::Expression { .. } | PieceKind::Literal { .. })
    }

    /// Is a space missing between the previous part and this one? Both still print as separate words. A value without a letter is
    /// never separated, because it could belong to either word.
    pub fn lacks_blank_after(&self, before: &Piece) -> bool {
        let begins = match self.kind {
            PieceKind::Variable { letter, .. } | PieceKind::Expression { letter, .. } => letter.is_some(),
            PieceKind::Literal { .. } | PieceKind::Note { .. } => true,
            PieceKind::TextVariable { .. } | PieceKind::Quote(_) | PieceKind::Stray(_) => false,
        };
        before.is_word() && begins
    }
}
