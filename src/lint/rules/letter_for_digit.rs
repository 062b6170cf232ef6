//! PF206: `GO` and `M3O` have the letter O, or a lower-case l, instead of a digit.

use crate::diag::{Code, Diag};
use crate::lint::tokens::looks_like_a_code;
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{Piece, PieceKind, Word};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let words: Vec<_> = view.written().map(plain).collect();
    for (i, word) in words.iter().enumerate() {
        let Some((text, span)) = *word else { continue };
        let Some(meant) = meant(text) else { continue };
        let is = |at: Option<usize>, what: &str| {
            let word = at.and_then(|at| *words.get(at)?);
            word.is_some_and(|(text, _)| text.eq_ignore_ascii_case(what))
        };
        // allowed words: `IF .. GO TO 5`, and names of programs after CALL on an Okuma
        if is(i.checked_add(1), "TO") || is(i.checked_sub(1), "CALL") {
            continue;
        }
        diags.push(
            Diag::new(Code::PF206, format!("`{text}` has a letter where a digit belongs"))
                .at(span, "printed as text")
                .help(format!("write `{meant}`"))
                .fix("write the digit", false, vec![(span, meant)]),
        );
    }
}

/// The text of a word, if the word has no variables.
fn plain(word: &Word) -> Option<(&str, Span)> {
    match word.pieces.as_ref() {
        [Piece { kind: PieceKind::Stray(text), span }] => Some((text, *span)),
        _ => None,
    }
}

/// The code that was probably intended. `None` if characters other than O, o, l and I are wrong.
fn meant(text: &str) -> Option<String> {
    let first = text.chars().next().filter(char::is_ascii_uppercase)?;
    let rest = &text[1..];
    let is_code = matches!(first, 'G' | 'M') || rest.bytes().any(|b| b.is_ascii_digit());
    let better: String = rest
        .chars()
        .map(|c| match c {
            'O' | 'o' => '0',
            'l' | 'I' => '1',
            c => c,
        })
        .collect();
    let better = format!("{first}{better}");
    (is_code && better != text && looks_like_a_code(&better)).then_some(better)
}
