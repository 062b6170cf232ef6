//! PF309: on Fanuc and Haas `X1` is a ten-thousandth of an inch, or a micron.

use crate::diag::{Code, Diag};
use crate::lang::is_cycle_code;
use crate::lint::view::View;
use crate::sema::{Line, Word, WordKind};
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_for(&["fanuc", "haas"]) {
        return;
    }
    // in the block of a cycle K counts how often, J of a tap how much faster it comes out; G5.1 has a mode in R
    let counts = |line: &Line, word: &Word| {
        let has = |asked: &dyn Fn(f64) -> bool| line.words.iter().any(|word| word.typed(b'G').is_some_and(asked));
        match word.letter() {
            Some(b'K') => has(&is_cycle_code),
            Some(b'J') => has(&|code| code == 74.0 || code.trunc() == 84.0),
            _ => has(&|code| code == 5.1),
        }
    };
    // `R1 = 5`: a register, not a word
    let is_register = |line: &Line, at: usize| {
        line.words.get(at + 1).is_some_and(|next| matches!(&next.kind, WordKind::Text(text) if text.starts_with('=')))
    };
    let lines = view.bodies.iter().flat_map(|body| body.lines);
    let words = lines.flat_map(|line| line.words.iter().enumerate().map(move |(at, word)| (line, at, word)));
    for (line, at, word) in words {
        if counts(line, word) || is_register(line, at) {
            continue;
        }
        let WordKind::Literal(letter, text, value) = &word.kind else { continue };
        let printed = view.letters[*letter].printed;
        let is_length = view.axis(*letter).is_some() || view.is_rotary(*letter) || b"UVWIJKR".contains(&printed);
        if !is_length || *value == 0.0 || text.contains('.') {
            continue;
        }
        let end = Span { start: word.span.end, ..word.span };
        diags.push(
            Diag::new(Code::PF309, format!("`{text}` has no point"))
                .at(word.span, "the control counts its smallest unit")
                .help(format!("write `{text}.`"))
                .fix("write the point", false, vec![(end, ".".into())]),
        );
    }
}
