//! PF112: `R [vclear]` and `M cool` print the letter and the number separately. `FF[frate]` prints a second letter. `[frate]`
//! prints a number without a letter.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{Piece, PieceKind, Word};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for words in view.written_lines().map(|body| view.codes(&body.words)) {
        let texts = words.iter().filter(|word| !is_code(word)).count();
        for (i, word) in words.iter().enumerate() {
            let before = i.checked_sub(1).map(|before| &words[before]);
            let among_codes = texts == usize::from(!is_code(word));
            let Some((span, label, help, edit)) = split(before, word, among_codes) else { continue };
            let diag = Diag::new(Code::PF112, "a malformed word").at(span, label).help(help);
            diags.push(match edit {
                Some((title, span, text)) => diag.fix(title, false, vec![(span, text)]),
                None => diag,
            });
        }
    }
}

type Found = (Span, &'static str, String, Option<(&'static str, Span, String)>);

/// The fault of a word: its location, a label, the correct text and the edit. `None` if the word is correct.
/// `among_codes`: each other word of the line consists of letters with values.
fn split(before: Option<&Word>, word: &Word, among_codes: bool) -> Option<Found> {
    let letter = before.and_then(letter_alone);
    match (word.pieces.as_ref(), letter, before) {
        // as in `R [vclear]` and `G 1`
        ([piece], Some(letter), Some(before)) if value(piece).is_some() => {
            let better = format!("{letter}{}", value(piece)?);
            let gap = Span { start: before.span.end, end: word.span.end, ..word.span };
            let label = "printed without its letter";
            Some((
                before.span.to(word.span),
                label,
                format!("write `{better}`"),
                Some(("join the word", gap, value(piece)?)),
            ))
        }
        // as in `FF[frate]` and `0[program#]`
        (
            [
                Piece { kind: PieceKind::Stray(text), span },
                Piece { kind: PieceKind::Variable { letter, name }, span: end },
            ],
            ..,
        ) => {
            let doubled = letter.is_some_and(|letter| text.as_bytes() == [letter]);
            let zero = letter.is_none() && text == "0";
            let better = match letter {
                Some(letter) if doubled => format!("{}[{}]", char::from(*letter), name.text),
                None if zero => format!("O[{}]", name.text),
                _ => return None,
            };
            let (label, text) = if zero { ("a zero for the letter O", "O") } else { ("the letter is given twice", "") };
            Some((span.to(*end), label, format!("write `{better}`"), Some(("write the word", *span, text.to_owned()))))
        }
        // `[frate]` between words with letters, but not after a text
        (
            [
                Piece {
                    kind:
                        PieceKind::Variable { letter: None, name } | PieceKind::Expression { letter: None, text: name, .. },
                    span,
                },
            ],
            None,
            Some(_),
        ) if among_codes => {
            let help = format!("write the letter before it, as `F[{}]`", name.text);
            Some((*span, "a number without its letter", help, None))
        }
        _ => None,
    }
}

/// Whether a word consists of letters with values.
fn is_code(word: &Word) -> bool {
    word.pieces.iter().all(Piece::is_word)
}

/// Whether the text is the name of a variable in lower-case letters.
fn is_variable(text: &str) -> bool {
    VarId::parse(text).is_some() && text.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit())
}

/// The letter of a word that consists of one capital letter.
fn letter_alone(word: &Word) -> Option<char> {
    match word.pieces.as_ref() {
        [Piece { kind: PieceKind::Stray(text), .. }] if text.len() == 1 => {
            text.chars().next().filter(char::is_ascii_uppercase)
        }
        _ => None,
    }
}

/// The correct text of a value that is written without a letter.
fn value(piece: &Piece) -> Option<String> {
    match &piece.kind {
        PieceKind::Variable { letter: None, name } => Some(format!("[{}]", name.text)),
        // as in `M cool`
        PieceKind::Stray(text) if is_variable(text) => Some(format!("[{text}]")),
        PieceKind::Stray(text) if text.parse::<f64>().is_ok() => Some(text.clone()),
        _ => None,
    }
}
