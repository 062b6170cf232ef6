//! The block numbers to which blocks of a program refer. These numbers have an effect on the machine.

use std::collections::HashSet;

use crate::nc::{Kind, Token, tokens};

/// The block numbers to which blocks of a program refer: by a jump, or as the ends of a profile of a lathe.
#[derive(Clone, Debug, Default)]
pub(super) struct Targets(HashSet<u64>);

/// The codes whose P and Q are block numbers: profiles of lathes, jumps, calls of blocks, returns to blocks.
const CODES: [(u8, f64); 7] =
    [(b'G', 70.0), (b'G', 71.0), (b'G', 72.0), (b'G', 73.0), (b'M', 96.0), (b'M', 97.0), (b'M', 99.0)];

impl Targets {
    /// Finds the references in a program.
    pub fn of(text: &[u8]) -> Targets {
        let mut targets = Targets::default();
        // a reference has a P, or the O of GOTO
        for [capital, small] in [*b"Pp", *b"Oo"] {
            // the end of the last line that was read
            let mut read = 0;
            for at in memchr::memchr2_iter(capital, small, text) {
                if at >= read {
                    let start = memchr::memrchr(b'\n', &text[read..at]).map_or(read, |end| read + end + 1);
                    read = memchr::memchr(b'\n', &text[at..]).map_or(text.len(), |end| at + end);
                    targets.read(&text[start..read]);
                }
            }
        }
        targets
    }

    /// Adds the references of a line.
    fn read(&mut self, line: &[u8]) {
        let words = || {
            tokens(line).filter_map(|token| match token.kind {
                Kind::Word(letter, number) => Some((letter, number.value)),
                _ => None,
            })
        };
        if words().any(|word| CODES.contains(&word)) {
            self.0.extend(words().filter(|(letter, _)| matches!(letter, b'P' | b'Q')).map(|(_, number)| number as u64));
        }
        let goes =
            |token: &Token| token.kind == Kind::Name && line[token.start..token.end].eq_ignore_ascii_case(b"GOTO");
        for token in tokens(line).filter(goes) {
            let digits = line[token.end..].trim_ascii_start();
            let length = digits.iter().take_while(|byte| byte.is_ascii_digit()).count();
            self.0.extend(std::str::from_utf8(&digits[..length]).ok().and_then(|digits| digits.parse::<u64>().ok()));
        }
    }

    /// Whether a block refers to this number.
    #[inline]
    pub fn has(&self, number: f64) -> bool {
        !self.0.is_empty() && self.0.contains(&(number as u64))
    }
}
