//! Text that is printed unchanged, from backquotes of a form or from a job. Words in such a text affect the known state
//! like the typed words of a form.

use super::line::Line;
use super::state::Said;
use crate::compile::LetterKind;
use crate::control::Code;
use crate::lang::{Machine, VarId};
use crate::nc::{Kind, Token, tokens};
use crate::number::quantise;
use crate::render::shape::Shape;
use crate::render::want::Want;

/// A word of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextWord {
    /// Letter, in upper case.
    pub letter: u8,
    /// Number after the letter.
    pub value: f64,
}

/// The words of a text outside comments, as the scanner of programs reads them. `None`: the text contains something
/// other than words, such as an expression, a name or a call by name. The effect of the text is then unknown. An
/// assignment to a program variable, such as `#500=1`, has no words and does not change the known state.
pub fn words_of(text: &[u8]) -> Option<Vec<TextWord>> {
    let mut words = Vec::new();
    let tokens = tokens(text).filter(|token| {
        !matches!(
            token.kind,
            Kind::Blank | Kind::LineEnd | Kind::Comment | Kind::OpenComment | Kind::Remark | Kind::Percent
        )
    });
    for (i, token) in tokens.enumerate() {
        match token.kind {
            Kind::Word(letter, number) => words.push(TextWord { letter, value: number.value }),
            Kind::Symbol(b'#') if i == 0 => return sets_variable(text).then_some(words),
            // block delete: the control may skip the words after it
            Kind::Delete if i == 0 => {}
            _ => return None,
        }
    }
    Some(words)
}

/// Addresses that describe the arc of a block and that other languages write with `=`, such as `I=AC(10)` and `CR=5` of
/// Siemens.
const OF_ARCS: [&str; 9] = ["I", "J", "K", "CR", "AR", "TURN", "I1", "J1", "K1"];

/// True if the text next to axis words contains only addresses of arcs, or parts of these addresses. Addresses of arcs
/// change only the move.
fn is_argument(text: &[u8]) -> bool {
    let mut parts = text.split(u8::is_ascii_whitespace).filter(|part| !part.is_empty());
    parts.all(is_of_arc)
}

fn is_of_arc(part: &[u8]) -> bool {
    match part.split(|&byte| byte == b'=').collect::<Vec<_>>()[..] {
        [closing] => !closing.is_empty() && closing.iter().all(|byte| b")]".contains(byte)),
        [name, value] => {
            let is_value = |byte: &u8| byte.is_ascii_digit() || b"+-.()".contains(byte);
            let value = value.strip_prefix(b"AC(").or_else(|| value.strip_prefix(b"IC(")).unwrap_or(value);
            OF_ARCS.iter().any(|own| own.as_bytes() == name) && value.iter().all(is_value)
        }
        _ => false,
    }
}

/// Whether a text that begins with `#` is an assignment to a variable of the program. Assignments to variables of the
/// control do not count.
fn sets_variable(text: &[u8]) -> bool {
    let mut tokens = tokens(text).filter(|token| token.kind != Kind::Blank).skip(1);
    let own = match tokens.next().map(|token| token.kind) {
        Some(Kind::Number(number)) => (1.0..=999.0).contains(&number.value),
        Some(Kind::Quoted) => true,
        _ => false,
    };
    own && tokens.next().is_some_and(|token| token.kind == Kind::Symbol(b'='))
}

impl Said {
    /// Records a printed text. The effect of plain words is known; the effect of any other text is unknown. In a form
    /// without a control, any other text invalidates only positions and modal words, because the language of the text
    /// is unknown too. A text inside a cycle belongs to the cycle; the end of the cycle invalidates positions.
    #[cold]
    pub fn text(&mut self, text: &[u8], line: Line, want: &Want, shape: &Shape) {
        let program = shape.program;
        if !program.settings.control().prints_codes() {
            // text next to axis words is a part of the move, as `R0 FMAX`
            let moves = |token: Token| matches!(token.kind, Kind::Word(letter, _) if shape.axis_bit(letter) != 0);
            if want.cycle.is_none() && (!line.prints_axes(shape) || tokens(text).any(moves)) {
                self.forget_motions(shape);
            }
            return;
        }
        let Some(words) = words_of(text) else {
            match program.settings.control {
                _ if want.cycle.is_some() => {}
                _ if line.prints_axes(shape) && is_argument(text) => {}
                Some(_) => self.calls = true,
                None if program.speaks_g => self.forget_motions(shape),
                None => {}
            }
            return;
        };
        let may_be_skipped = text.trim_ascii_start().starts_with(b"/");
        for word in words {
            if may_be_skipped {
                self.skipped_word(word, line, want, shape);
            } else {
                self.text_word(word, line, want, shape);
            }
        }
    }

    /// Records a word of a text like a typed word.
    fn text_word(&mut self, word: TextWord, line: Line, want: &Want, shape: &Shape) {
        let TextWord { letter, value } = word;
        if !letter.is_ascii_uppercase() {
            return;
        }
        if let Some(code) = Code::of(letter, value) {
            self.code(code, line, want, shape);
            return;
        }
        self.displaced(shape.axis_bit(letter), shape);
        let info = &shape.letters[letter];
        match quantise(value, info.format.dec.count) {
            Some(units) if info.kind == LetterKind::Other => self.word(info, units),
            _ => self.forget(info),
        }
        self.speed_word(letter, value, line, want, shape);
    }

    /// Records a word after the slash of block delete. The control may skip such a word, so its effect is unknown.
    fn skipped_word(&mut self, word: TextWord, line: Line, want: &Want, shape: &Shape) {
        let TextWord { letter, value } = word;
        self.speed_word(letter, value, line, want, shape);
        if let Some(code) = Code::of(letter, value) {
            self.code(code, line, want, shape);
            if let Some(group) = shape.group_of(code) {
                self.registers.forget_group(group);
            }
        }
        self.lose_start(shape.axis_bit(letter), shape);
        self.registers.forget(letter);
    }

    /// Records a run of external code, such as a macro: everything that the external code may have changed becomes
    /// unknown. In a cycle the external code makes the holes.
    pub(super) fn called(&mut self, want: &Want, shape: &Shape) {
        self.forget_motions(shape);
        if want.cycle.is_some() {
            return;
        }
        self.plane = None;
        for var in [VarId::Work, VarId::Speed, VarId::Direct, VarId::Feedtype] {
            self.conditions.put(var, None);
        }
        // some mills have no G97
        if shape.program.settings.machine == Machine::Lathe {
            self.conditions.put(VarId::Speedtype, None);
        }
        self.differs = true;
    }

    /// Forgets positions, motions and all words.
    fn forget_motions(&mut self, shape: &Shape) {
        self.forget_words();
        self.moves_itself(shape);
        self.forget_motion();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Option<String> {
        let shown = |word: &TextWord| format!("{}{}", char::from(word.letter), word.value);
        words_of(text.as_bytes()).map(|words| words.iter().map(shown).collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn a_text_is_its_words_or_unknown() {
        for (text, expected) in [
            ("G65 P9023 Z-20. F500", Some("G65 P9023 Z-20 F500")),
            ("m8(COOLANT G1) ; M9", Some("M8")),
            ("/M8", Some("M8")),
            ("#500=[#500+1]", Some("")),
            ("#<count> = 1", Some("")),
            ("%", Some("")),
            ("#3006=1(CHECK)", None),
            ("#5221=0", None),
            ("Z#1", None),
            ("Z[1+2]", None),
            ("o<sub> call", None),
            ("IF[#1EQ0]GOTO10", None),
            ("L X+10 R0 FMAX", None),
            ("MCALL CYCLE81(10,0)", None),
        ] {
            assert_eq!(words(text), expected.map(str::to_owned), "{text}");
        }
    }
}
