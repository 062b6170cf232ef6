//! The effect of text items on the operations after them, for text that is left out with its operation.

use crate::control::{Code, Control, Meaning};
use crate::lang::Coolant;
use crate::nc::{Kind, Rotation, coolant_of, rotation_of, tokens};
use crate::toolpath::Spindle;

/// The state that a text item leaves active.
#[derive(Default)]
pub(super) struct Left {
    pub spindle: Spindle,
    pub coolant: Option<Coolant>,
    pub other: Other,
}

/// An effect of a text that is neither a state of the spindle nor a kind of coolant that every form has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Other {
    #[default]
    None,
    /// The effect is on the spindle or the coolant, and ends at the change to another tool.
    UntilTool,
    Unknown,
}

impl Left {
    /// Reads a text item by the codes of a control.
    pub fn by(text: &str, control: &Control) -> Left {
        let mut left = Left::default();
        let (mut waits, mut has_words) = (false, false);
        for token in tokens(text.as_bytes()) {
            match token.kind {
                Kind::Blank | Kind::LineEnd | Kind::Comment | Kind::Remark | Kind::Word(b'N', _) => {}
                Kind::Word(b'S', number) => left.spindle.speed = Some(number.value),
                Kind::Word(letter @ (b'G' | b'M'), number) => {
                    let meaning = Code::of(letter, number.value).and_then(|code| control.meaning(code));
                    waits |= meaning == Some(Meaning::Dwell);
                    left.code(meaning.unwrap_or(Meaning::Unsaid));
                }
                Kind::Word(..) => has_words = true,
                _ => left.other = Other::Unknown,
            }
        }
        if has_words && !waits {
            left.other = Other::Unknown;
        }
        left
    }

    fn code(&mut self, meaning: Meaning) {
        use Meaning as M;
        let turn = rotation_of(meaning).map(Rotation::turn);
        let coolant = coolant_of(meaning).filter(|_| meaning != M::Through);
        let other = match meaning {
            _ if turn.is_some() || coolant.is_some() => Other::None,
            M::Through | M::Orient => Other::UntilTool,
            M::Dwell | M::StopProgram | M::StopOptional | M::ExactStop | M::Harmless => Other::None,
            _ => Other::Unknown,
        };
        self.spindle.turn = turn.or(self.spindle.turn);
        self.coolant = coolant.or(self.coolant);
        self.other = self.other.max(other);
    }
}
