//! PF309: a number is written without a decimal point. Fanuc and Haas read `X1` as 0.0001 inch or 0.001 mm.

use crate::control::{self, Hole, Meaning, Row, WithoutPoint};
use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::{Line, Word, WordKind};
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.traits().without_point != WithoutPoint::LeastIncrement {
        return;
    }
    // exceptions: K in a cycle is a count, J in a tap is a factor of the retract speed, R in G5.1 is a mode
    let counting = |line: &Line| {
        let codes = view.settings.codes();
        let has = |asked: &dyn Fn(control::Code) -> bool| line.words.iter().filter_map(Word::code).any(asked);
        let taps = |row: &Row| row.makes.iter().any(|hole| matches!(hole, Hole::Tap | Hole::LeftTap));
        let cycle = has(&|code| codes.meaning(code).is_some_and(Meaning::is_cycle));
        let tap = has(&|code| codes.row(code).is_some_and(taps));
        [cycle, tap, has(&|code| code.to_string() == "G5.1")]
    };
    let counts = |[cycle, tap, mode]: [bool; 3], word: &Word| match word.letter() {
        Some(b'K') => cycle,
        Some(b'J') => tap,
        _ => mode,
    };
    // `R1 = 5` sets a register and is not a word with a value
    let is_register = |line: &Line, at: usize| {
        line.words.get(at + 1).is_some_and(|next| matches!(&next.kind, WordKind::Text(text) if text.starts_with('=')))
    };
    let lines = view.bodies.iter().flat_map(|body| body.lines).map(|line| (line, counting(line)));
    let words = lines.flat_map(|(line, codes)| line.words.iter().enumerate().map(move |word| (line, codes, word)));
    for (line, codes, (at, word)) in words {
        if counts(codes, word) || is_register(line, at) {
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
                .at(word.span, "the control reads the number in its smallest unit")
                .help(format!("write `{text}.`"))
                .fix("write the point", false, vec![(end, ".".into())]),
        );
    }
}
