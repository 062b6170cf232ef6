//! The syntax tree. The tree contains each name, letter, variable, number, comment and ignored rest of a line with its
//! location.

use super::expression::{Expr, Unread};
use crate::span::Span;

/// Text of a form with its location.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spanned {
    /// The text as written.
    pub text: String,
    /// Location.
    pub span: Span,
}

/// The tree of one file.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Form {
    /// The lines outside sequences, and the sequences, in the order of the file.
    pub items: Vec<Head>,
}

impl Form {
    /// The commands, and lines that look like a command.
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
        /// The text after the letter, such as `->3.>4`.
        spec: Spanned,
    },
    /// A command, or a line that looks like a command.
    Statement(Statement),
    /// An `End` outside a sequence.
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

/// A command or a name line, such as `Rapid G0` or `Custom1   Face`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// The line.
    pub line: Line,
    /// The first word of the line.
    pub name: Spanned,
    /// The words after the first word, without quotes.
    pub args: Vec<Spanned>,
}

impl Statement {
    /// The words after the first word as one text, such as a file name with spaces.
    pub fn argument(&self) -> String {
        self.args.iter().map(|arg| arg.text.as_str()).collect::<Vec<_>>().join(" ")
    }
}

/// A sequence, from its name line to its `End`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SequenceNode {
    /// The name line.
    pub name: Statement,
    /// The lines between name and end.
    pub body: Vec<Body>,
    /// The end. `None` if the file ends or another sequence begins before an `End`.
    pub end: Option<End>,
}

impl SequenceNode {
    /// The location from the name line to the end, or to the last line if the end is missing.
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
    /// The words of the line. The list is empty on an empty line, and for a comment or a directive.
    pub words: Vec<Word>,
    /// The directive, if the line is a directive instead of words.
    pub directive: Option<Box<Directive>>,
}

/// A directive, such as `@if [cool] = through`. A directive selects the lines that print.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Directive {
    /// The name as written, such as `@if`.
    pub name: Spanned,
    /// The text after the name, without the comment.
    pub rest: Spanned,
    /// Kind of the directive.
    pub kind: DirectiveKind,
}

/// The kinds of directives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DirectiveKind {
    /// `@if`: the next lines print if the condition is true.
    If(Result<Expr, Unread>),
    /// `@elif`: the next lines print if the condition is true and no earlier condition is true.
    Elif(Result<Expr, Unread>),
    /// `@else`: the next lines print if no earlier condition is true.
    Else,
    /// `@end`, which ends the lines of `@if` or `@for`.
    End,
    /// `@for`: the next lines print once for each item of a list.
    For,
    /// `@set NAME = value`, which sets a variable or property.
    Set(Spanned, Result<Expr, Unread>),
    /// `@` with any other name.
    Unknown,
}

impl DirectiveKind {
    /// Whether the directive begins lines that end with an `@end`.
    pub fn opens(&self) -> bool {
        matches!(self, DirectiveKind::If(_) | DirectiveKind::For)
    }

    /// Whether the directive ends the lines of a branch.
    pub fn closes(&self) -> bool {
        matches!(self, DirectiveKind::Elif(_) | DirectiveKind::Else | DirectiveKind::End)
    }
}

/// The end of a sequence: `End` or `End Cancel`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct End {
    /// The line.
    pub line: Line,
    /// Location of the word `End`.
    pub word: Span,
    /// The words after `End`.
    pub args: Vec<Spanned>,
}

/// A word: the text between two spaces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Location.
    pub span: Span,
    /// The parts of the word. A word has several parts if a space is missing, or if the word is a text with variables.
    pub pieces: Box<[Piece]>,
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
    /// A variable with or without a letter, such as `X[h]` or `<work>`.
    Variable {
        /// The letter, if any.
        letter: Option<u8>,
        /// The name between the brackets.
        name: Spanned,
    },
    /// A letter with a number, such as `G0`, `P.5` or `%0`.
    Literal {
        /// The letter.
        letter: u8,
        /// The number as written.
        number: Spanned,
    },
    /// A calculated value, such as `[h+1]`.
    Expression {
        /// The letter, if any.
        letter: Option<u8>,
        /// The text between the brackets.
        text: Spanned,
        /// The expression as a tree.
        expr: Box<Result<Expr, Unread>>,
    },
    /// A variable with a text value, such as `[toolname]` or `[toolname:12]`.
    TextVariable {
        /// The letter before the variable, which is an error.
        letter: Option<u8>,
        /// The name between the brackets, with its width.
        name: Spanned,
    },
    /// The text in backquotes, which is printed as written.
    Quote(String),
    /// Any other text, as written.
    Stray(String),
    /// A comment of the program, such as `(TOOL [tool])`.
    Note {
        /// The text and variables of the comment in their order, without the comment marks.
        parts: Box<[Piece]>,
        /// Whether the comment has its closing mark.
        closed: bool,
    },
}

impl Body {
    /// The first part of each printed word. Text in backquotes counts as one word together with the parts joined to
    /// this text.
    pub fn begins(&self) -> impl Iterator<Item = &Piece> {
        self.words.iter().flat_map(|word| {
            let is_first = move |at: usize| at == 0 || word.pieces[at].lacks_blank_after(&word.pieces[at - 1]);
            (0..word.pieces.len()).filter(move |&at| is_first(at)).map(move |at| &word.pieces[at])
        })
    }
}

impl Piece {
    /// Whether the part is a complete word with a value.
    pub fn is_word(&self) -> bool {
        matches!(self.kind, PieceKind::Variable { .. } | PieceKind::Expression { .. } | PieceKind::Literal { .. })
    }

    /// Whether a space is missing between the previous part and this part. Both parts are still printed as separate
    /// words. Before a value without a letter, a space never counts as missing, because the value may belong to the
    /// word before it.
    pub fn lacks_blank_after(&self, before: &Piece) -> bool {
        let begins = match self.kind {
            PieceKind::Variable { letter, .. } | PieceKind::Expression { letter, .. } => letter.is_some(),
            PieceKind::Literal { .. } | PieceKind::Note { .. } => true,
            PieceKind::TextVariable { .. } | PieceKind::Quote(_) | PieceKind::Stray(_) => false,
        };
        before.is_word() && begins
    }
}
