//! Classifies the words in a form for syntax colouring.

use super::{At, Document, What};
use crate::span::Span;
use crate::syntax::{Head, Line, Piece, PieceKind, Tail};

/// A coloured word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// Span of the word. The span is within one line.
    pub span: Span,
    /// Kind of the word.
    pub kind: Kind,
}

/// Kinds of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A command.
    Command,
    /// An argument of a command.
    Argument,
    /// A letter format.
    Format,
    /// A sequence's name.
    Sequence,
    /// `Upon`, `End`, `Cancel`, `None`.
    Keyword,
    /// A word with a variable.
    Variable,
    /// A G or M code.
    Code,
    /// Any other word that is written in the form.
    Word,
    /// A comment of the program, or text in backquotes.
    Note,
    /// A comment of the form.
    Comment,
    /// Text after two spaces, which is not printed.
    Lost,
}

impl Document {
    /// The words of a file in their order. No word contains another word.
    pub fn tokens(&self, file: u32) -> Vec<Token> {
        let mut tokens = Vec::new();
        self.each(file, |At { span, what }| {
            let kind = match what {
                What::Command(_) => Kind::Command,
                What::Argument(..) => Kind::Argument,
                What::Format(_) => Kind::Format,
                What::Sequence(_) => Kind::Sequence,
                What::Upon | What::End | What::Cancel | What::Nothing => Kind::Keyword,
                What::Variable(..) | What::Text(_) | What::Property(_) => Kind::Variable,
                What::Quote => Kind::Note,
                What::Code(_) => Kind::Code,
                What::Word(_) => Kind::Word,
            };
            tokens.push(Token { span, kind });
        });
        let lines = self.checked.trees.get(file as usize).map(|tree| tree.lines()).unwrap_or_default();
        tokens.extend(lines.into_iter().filter_map(tail));
        tokens.sort_by_key(|token| token.span.start);
        let mut around = Vec::new();
        for item in self.items(file) {
            let Head::Sequence(node) = item else { continue };
            let pieces = node.body.iter().flat_map(|body| &body.words).flat_map(|word| &word.pieces);
            pieces.for_each(|piece| notes(piece, &tokens, &mut around));
        }
        tokens.extend(around);
        tokens.retain(|token| token.span.start < token.span.end);
        tokens.sort_by_key(|token| token.span.start);
        tokens
    }
}

fn tail(line: &Line) -> Option<Token> {
    match &line.tail {
        Tail::None => None,
        Tail::Comment(span) => Some(Token { span: *span, kind: Kind::Comment }),
        Tail::Lost(lost) => Some(Token { span: lost.span, kind: Kind::Lost }),
    }
}

/// Adds the parts of a program's comment that are before, between and after the words in the comment. `tokens`: the
/// words of the file in their order.
fn notes(piece: &Piece, tokens: &[Token], notes: &mut Vec<Token>) {
    if !matches!(piece.kind, PieceKind::Note { .. }) {
        return;
    }
    let (mut at, end) = (piece.span.start, piece.span.end);
    let first = tokens.partition_point(|token| token.span.start < at);
    for inner in tokens[first..].iter().take_while(|token| token.span.start < end) {
        notes.push(Token { span: Span { start: at, end: inner.span.start, ..piece.span }, kind: Kind::Note });
        at = inner.span.end;
    }
    notes.push(Token { span: Span { start: at, ..piece.span }, kind: Kind::Note });
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::{haas, marked};
    use super::*;

    #[test]
    fn every_word_has_its_kind() {
        let (document, _) = marked(
            "Units mm # metric\nX->3.>4\nDrill\nG81 X[h] Q5 (TOOL [tool] [toolname:8]) `#1 IN`\nEnd Cancel   lost\n",
        );
        let told: Vec<_> = document.tokens(0).iter().map(|token| (document.slice(token.span), token.kind)).collect();
        assert_eq!(
            told,
            [
                ("Units", Kind::Command),
                ("mm", Kind::Argument),
                ("# metric", Kind::Comment),
                ("X->3.>4", Kind::Format),
                ("Drill", Kind::Sequence),
                ("G81", Kind::Code),
                ("X[h]", Kind::Variable),
                ("Q5", Kind::Word),
                ("(TOOL ", Kind::Note),
                ("[tool]", Kind::Variable),
                (" ", Kind::Note),
                ("[toolname:8]", Kind::Variable),
                (")", Kind::Note),
                ("`#1 IN`", Kind::Note),
                ("End", Kind::Keyword),
                ("Cancel", Kind::Keyword),
                ("lost", Kind::Lost),
            ]
        );
    }

    /// A calculated value in a comment is a separate word.
    #[test]
    fn a_comment_is_around_its_calculated_values() {
        let (document, _) = marked("Drill\n(P[work-59] X[h])\nEnd\n");
        let told: Vec<_> = document.tokens(0).iter().map(|token| document.slice(token.span)).collect();
        assert_eq!(told, ["Drill", "(P[", "work", "-59] X", "[h]", ")", "End"]);
    }

    #[test]
    fn no_token_lies_in_another() {
        let (document, _) = haas("", "");
        let tokens = document.tokens(0);
        assert!(tokens.len() > 100);
        for pair in tokens.windows(2) {
            assert!(pair[0].span.end <= pair[1].span.start, "{:?}", document.slice(pair[0].span));
        }
    }
}
