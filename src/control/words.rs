//! Sets of word letters.

/// Letters of words, `A` to `Z`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Words(u32);

impl Words {
    /// None of them.
    pub const NONE: Words = Words(0);

    /// All of them.
    pub const ALL: Words = Words::of("ABCDEFGHIJKLMNOPQRSTUVWXYZ");

    /// Is this letter one of them?
    pub const fn has(self, letter: u8) -> bool {
        letter.is_ascii_uppercase() && self.0 & 1 << (letter - b'A') != 0
    }

    /// The set of the capital letters in a text; other characters count for nothing.
    pub const fn of(text: &str) -> Words {
        let (mut bits, mut i) = (0, 0);
        while i < text.len() {
            let letter = text.as_bytes()[i];
            if letter.is_ascii_uppercase() {
                bits |= 1 << (letter - b'A');
            }
            i += 1;
        }
        Words(bits)
    }

    /// As bits: bit 0 is A.
    pub const fn bits(self) -> u32 {
        self.0
    }
}
