//! Sets of word letters.

/// Letters of words, `A` to `Z`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Words(u32);

impl Words {
    /// The empty set.
    pub const NONE: Words = Words(0);

    /// All letters.
    pub const ALL: Words = Words::of("ABCDEFGHIJKLMNOPQRSTUVWXYZ");

    /// Whether the letter is in the set.
    pub const fn has(self, letter: u8) -> bool {
        letter.is_ascii_uppercase() && self.0 & 1 << (letter - b'A') != 0
    }

    /// The set of the capital letters in a text. Other characters are ignored.
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

    /// The set as bits: bit 0 is A.
    pub const fn bits(self) -> u32 {
        self.0
    }
}
